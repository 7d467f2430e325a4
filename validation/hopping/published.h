// What was published about a robot, as data: quantities with their source, and how they are measured here.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/hopping/measures.h"

namespace plumbline::validation {

struct Published {
  /// How the value binds: equal within the tolerance, or a limit.
  enum class Relation { value, at_most, at_least };
  std::string name;
  const Measure* measure = nullptr;
  Relation relation = Relation::value;
  model::Quantity quantity;   ///< SI; its unit is the file's
  model::Quantity tolerance;  ///< SI, >= 0; beyond a limit by less than this still holds

  /// By how much a measured value is outside the tolerance, SI, signed; 0 within it.
  double outside(double measured) const;
  /// How far it is from the value, or beyond the limit, in units of the tolerance (which must not be 0).
  double deviation(double measured) const;
};

std::string to_string(Published::Relation relation);

/// What was published about a robot, and the files that play it (paths, resolved against the file's folder).
struct PublishedRobot {
  std::string model, controller;
  std::string tuned_rigid;  ///< constants of the controller that were found on rigid cables; empty: none
  std::vector<Published> quantities;
};

/// Reads `plumbline: published/1`. Throws InputError (one line: file, line, key, found, expected).
PublishedRobot read_published(const std::string& path);

}  // namespace plumbline::validation
