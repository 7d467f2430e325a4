#include "simulator/effects/torque_bias.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kBias };

}  // namespace

const Declaration& TorqueBias::declaration() const {
  static const Declaration kDeclaration{
      "torque_bias",
      "a constant offset of the torque, as amplifiers have it",
      "torque = u + bias",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, Sidebar 1 and Table VII",
      {Place::motor},
      {any("bias", "{force}", "torque at zero command")},
      {},
      ""};
  return kDeclaration;
}

Values TorqueBias::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force};
}

std::vector<Values> TorqueBias::starts(const Scales& /*scales*/) const { return {null_values()}; }

double TorqueBias::torque(double commanded, const double* /*state*/, const double* p) const {
  return commanded + p[kBias];
}

}  // namespace plumbline::effects
