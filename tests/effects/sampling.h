// Random but repeatable motions and parameters, for tests that walk the whole catalogue.
#pragma once

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "simulator/effects/catalogue.h"

namespace plumbline::effects {

/// Magnitudes away from one, so that a mixed-up factor shows.
Scales test_scales();

std::vector<std::shared_ptr<const Law>> all_laws();
std::vector<std::shared_ptr<const ForceLaw>> force_laws();

/// The values of a named law: null (standard) values with those given replaced.
Values values_of(const Law& law, const std::vector<std::pair<std::string, double>>& given);

class Sampler {
 public:
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  double sign() { return between(0, 1) < 0.5 ? -1.0 : 1.0; }

  /// Not null, inside the bounds, of typical size; structural values come from one of the law's starts.
  Values parameters(const Law& law);
  Motion motion();
  /// States of typical size: a bristle inside the range that it never leaves, anything elsewhere.
  std::vector<double> states(const Law& law, const Values& p);

 private:
  std::mt19937 random_{20240229};
};

}  // namespace plumbline::effects
