// The random part of a case. The same seed gives the same numbers for a case, whichever others are run.
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include "tests/battery/cases.h"

namespace plumbline::battery {

constexpr double kMostDeviations = 2.0;  ///< of a number from what is stated of it
constexpr double kSpread = 0.2;  ///< share of the nominal value by which a drawn value differs at most

/// Uniform numbers for one case and one seed; the same on every platform.
class Draw {
 public:
  Draw(const Case& one, std::uint64_t seed);
  /// Uniform in 1 +- kSpread.
  double factor();
  /// Normal with deviation 1, at most kMostDeviations from 0.
  double deviations();
  /// A seed for what draws by itself.
  std::uint64_t seed() { return random_(); }

 private:
  double unit();  ///< in [0, 1)

  std::mt19937_64 random_;
};

/// The effect of a row at a strength, "coulomb@mLA:level=0.0193,smoothing_speed=0.03": every parameter that
/// is not structural is drawn around its nominal value. Throws std::invalid_argument when the row cannot be
/// read or names an unknown effect or parameter.
std::string drawn_effect(const Row& row, Strength strength, const effects::Catalogue& catalogue, Draw& draw);

/// The robot itself, which is never quite as its model states: every mass (with its inertia about the centre
/// of mass), rotor inertia, torque constant and value of an effect is drawn within its stated uncertainty.
model::Model scattered(const model::Model& stated, Draw& draw);

}  // namespace plumbline::battery
