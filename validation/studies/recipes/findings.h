// What a recipe's steps find.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace plumbline::validation {

/// One unknown as one step found it. SI.
struct IdentifiedValue {
  std::string unknown;
  double value = 0.0;
  double deviation = 0.0;  ///< one standard deviation
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool seen = true;  ///< false: the data do not depend on it
};

/// A combination of free unknowns that the data hardly tell: a unit vector in shares of the values, and the
/// standard deviation along it (1: as large as the values themselves).
struct WeakDirection {
  double deviation = 0.0;
  std::vector<std::pair<std::string, double>> parts;  ///< largest first
};

struct StrongCorrelation {
  std::string one, other;
  double value = 0.0;
};

struct StepResult {
  std::string step;
  std::vector<IdentifiedValue> findings;        ///< free unknowns, in the recipe's order
  std::vector<IdentifiedValue> updated;         ///< known unknowns, as they stand behind the step
  std::vector<StrongCorrelation> correlations;  ///< between free unknowns, beyond 0.95
  std::vector<WeakDirection> weak;
  double before = 0.0, after = 0.0;  ///< error in units of the floor; 0: the method has none
  int windows = 0;                   ///< windows, postures or samples that were used
  bool converged = true;
  double seconds = 0.0;
};

/// True values by unknown; those without a stated value have none.
using Truth = std::map<std::string, double>;

/// What is known of an unknown on the way.
struct Knowledge {
  double value = 0.0, deviation = 0.0;
};
using KnowledgeMap = std::map<std::string, Knowledge>;

}  // namespace plumbline::validation
