// What others have published about a robot's data: reference.yaml beside its model.
#pragma once

#include <string>
#include <vector>

namespace plumbline::validation {

/// A published number and what it is compared with.
struct ReferenceValue {
  enum class Quantity { closed_loop_position, closed_loop_force, inverse_force };
  Quantity quantity = Quantity::inverse_force;
  std::string model;  ///< which model they had, in words
  std::string data;   ///< name of the data file it belongs to
  double percent = 0.0;
  std::string source;
};

std::string to_string(ReferenceValue::Quantity quantity);

/// `plumbline: reference/1`, a list under `values`; see docs/formats.md. Throws InputError (file, line, key,
/// found, expected) on anything else.
std::vector<ReferenceValue> read_reference(const std::string& path);

/// reference.yaml in the folder of the model file; empty when there is none.
std::string reference_beside(const std::string& model_file);

}  // namespace plumbline::validation
