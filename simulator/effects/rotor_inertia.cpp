#include "simulator/effects/rotor_inertia.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kInertia };

}  // namespace

const Declaration& RotorInertia::declaration() const {
  static const Declaration kDeclaration{
      "rotor_inertia",
      "inertia at a motor beyond the stated one",
      "inertia of the motor + inertia",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, Table V (correction factor alpha_rotor)",
      {Place::motor},
      {any("inertia", "{inertia}",
           "added inertia; negative: the stated one is too high, but the total stays positive")},
      {},
      ""};
  return kDeclaration;
}

Values RotorInertia::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.inertia};
}

std::vector<Values> RotorInertia::starts(const Scales& /*scales*/) const { return {null_values()}; }

StructureChange RotorInertia::change(const double* p) const {
  StructureChange result;
  result.inertia = p[kInertia];
  return result;
}

}  // namespace plumbline::effects
