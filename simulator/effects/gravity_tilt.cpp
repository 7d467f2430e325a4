#include "simulator/effects/gravity_tilt.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kRoll, kPitch };

constexpr double kLargestTilt = 0.5 * kPi;  // beyond it down would be up

}  // namespace

const Declaration& GravityTilt::declaration() const {
  static const Declaration kDeclaration{"gravity_tilt",
                                        "a base that is not level: gravity turned in the world frame",
                                        "gravity turned by the rotation vector (roll, pitch, 0)",
                                        "Featherstone, Rigid Body Dynamics Algorithms, 2008",
                                        {Place::world},
                                        {Parameter{"roll", "rad", "rotation of gravity about the world's x",
                                                   0.0, -kLargestTilt, kLargestTilt, Scale::linear, false},
                                         Parameter{"pitch", "rad", "rotation of gravity about the world's y",
                                                   0.0, -kLargestTilt, kLargestTilt, Scale::linear, false}},
                                        {},
                                        ""};
  return kDeclaration;
}

// Gravity's size is not among the scales; a tenth of a radian turns a tenth of the weight sideways.
Values GravityTilt::typical(const Scales& /*scales*/) const { return {0.1, 0.1}; }

std::vector<Values> GravityTilt::starts(const Scales& /*scales*/) const { return {null_values()}; }

StructureChange GravityTilt::change(const double* p) const {
  StructureChange result;
  result.tilt = {p[kRoll], p[kPitch], 0.0};
  return result;
}

}  // namespace plumbline::effects
