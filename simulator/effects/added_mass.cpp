#include "simulator/effects/added_mass.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kMass };

}  // namespace

const Declaration& AddedMass::declaration() const {
  static const Declaration kDeclaration{
      "added_mass",
      "mass of a body beyond the stated one, at its centre of mass",
      "mass of the body + mass",
      "Atkeson, An and Hollerbach, Estimation of inertial parameters of manipulator loads and links, Int. J. "
      "of Robotics Research 5(3), 1986",
      {Place::body},
      {any("mass", "kg", "added mass; negative: the stated one is too high, but the total stays positive")},
      {},
      ""};
  return kDeclaration;
}

Values AddedMass::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.inertia};
}

std::vector<Values> AddedMass::starts(const Scales& /*scales*/) const { return {null_values()}; }

StructureChange AddedMass::change(const double* p) const {
  StructureChange result;
  result.mass = p[kMass];
  return result;
}

}  // namespace plumbline::effects
