// What a step's data do not tell, in plain terms.
#pragma once

#include <string>
#include <vector>

#include "validation/studies/recipes/findings.h"
#include "validation/studies/recipes/recipe.h"

namespace plumbline::validation {

struct Untold {
  std::string unknown;
  double width = 0.0;           ///< of its interval, as a share of that size; infinite: not seen at all
  StrongCorrelation strongest;  ///< that it has part in; without a name: none
};

/// The step's unknowns whose interval is wider than half of their size: the value that was found, that which
/// was stated, or its stated deviation, whichever is largest. Those with a target are left to it.
std::vector<Untold> untold(const Recipe& recipe, const StepResult& result);

}  // namespace plumbline::validation
