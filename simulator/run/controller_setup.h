// A controller's file: its library, its constants, and which sensor or motor each of its ports is.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "controllers/host/loaded_controller.h"
#include "simulator/model/model.h"
#include "simulator/trace/error.h"

namespace plumbline::run {

/// What an input port may be. The port's number is the source's (counts, a reading, 0 or 1) with
/// scale = resolution / divide_by.
struct InputWire {
  enum class Kind { named, sensor, contact_switch, foot, fixed };
  Kind kind = Kind::named;  ///< named: a sensor or a contact switch
  std::string name;
  double divide_by = 1.0;  ///< SI
  std::string divide_unit = "1";
  double value = 0.0;  ///< of a fixed one, SI
};

/// `plumbline: controller/2`, read and checked against the library that it names.
struct ControllerSetup {
  std::string file, title;
  controllers::LoadedController library;
  double period = 0.0;                      ///< s
  std::vector<double> constants;            ///< in the order of the library, SI
  std::vector<model::Quantity> quantities;  ///< the same with unit and source
  /// For each input, in the order of the library: what it may be, the first that the model has.
  std::vector<std::vector<InputWire>> inputs;
  std::vector<std::string> outputs;  ///< motors, in the order of the library
  Place_in_file where;               ///< of `inputs`, for messages

  /// Index of a constant; throws InputError (nearest names) when the controller has none of this name.
  std::size_t constant_index(const std::string& name) const;
  double constant(const std::string& name) const { return constants[constant_index(name)]; }
  void set(const std::string& name, double value) { constants[constant_index(name)] = value; }
};

/// A file with a `base` states only what it changes of that file. Throws InputError (one line: file, line,
/// key, found, expected): a library that does not load or speaks another version, a constant or port that is
/// missing or that the library does not have, a unit of another dimension, a value outside the limits.
ControllerSetup read_controller(const std::string& path);

/// Writes the named constants as a file `path` on `base_file`, with a note and where they come from
/// ("found by search"). Throws InputError when the two are one file.
void write_constants(const std::string& path, const std::string& base_file, const ControllerSetup& setup,
                     const std::vector<std::string>& names, const std::string& note,
                     const std::string& origin);

}  // namespace plumbline::run
