#include "validation/studies/recipes/recipe.h"

#include <algorithm>
#include <stdexcept>

namespace plumbline::validation {
namespace {

template <typename Named>
const Named& named(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  if (found == all.end()) {
    throw std::logic_error("a recipe without '" + name + "'");
  }
  return *found;
}

}  // namespace

double Link::parameter(double unknown_value) const {
  return times * (power == 1 ? unknown_value : 1.0 / unknown_value) + plus;
}

double Link::unknown_of(double parameter_value) const {
  const double bare = (parameter_value - plus) / times;
  return power == 1 ? bare : 1.0 / bare;
}

double Link::slope(double unknown_value) const {
  return power == 1 ? times : -times / (unknown_value * unknown_value);
}

const Unknown& Recipe::unknown(const std::string& name) const { return named(unknowns, name); }
const LinkedModel& Recipe::model(const std::string& name) const { return named(models, name); }

}  // namespace plumbline::validation
