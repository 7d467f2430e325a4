#include "simulator/effects/torque_constant_error.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kScale };

}  // namespace

const Declaration& TorqueConstantError::declaration() const {
  static const Declaration kDeclaration{
      "torque_constant_error",
      "a torque constant that differs from the stated one",
      "torque = scale*u",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, Table V (correction factor alpha_torque)",
      {Place::motor},
      {Parameter{"scale", "1", "true torque constant over the stated one", 1.0, 0.0, kInfinity, Scale::linear,
                 false}},
      {},
      ""};
  return kDeclaration;
}

Values TorqueConstantError::typical(const Scales& /*scales*/) const { return {1.0}; }

std::vector<Values> TorqueConstantError::starts(const Scales& /*scales*/) const { return {null_values()}; }

double TorqueConstantError::torque(double commanded, const double* /*state*/, const double* p) const {
  return p[kScale] * commanded;
}

}  // namespace plumbline::effects
