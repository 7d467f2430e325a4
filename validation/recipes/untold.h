// What a step's data do not tell, in plain terms.
#pragma once

#include <string>
#include <vector>

#include "validation/recipes/findings.h"
#include "validation/recipes/recipe.h"

namespace plumbline::validation {

struct Untold {
  std::string unknown;
  double width = 0.0;           ///< of its interval, as a share of the value; infinite: not seen at all
  StrongCorrelation strongest;  ///< that it has part in; without a name: none
};

/// The step's unknowns whose interval is wider than half of the value, or of what was stated to be uncertain
/// of it, whichever is larger. Those with a target are left to it.
std::vector<Untold> untold(const Recipe& recipe, const StepResult& result);

}  // namespace plumbline::validation
