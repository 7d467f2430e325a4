#include "simulator/effects/com_shift.h"

#include <algorithm>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kX, kY, kZ };

constexpr double kStandardGravity = 9.80665;  // m/s^2

}  // namespace

const Declaration& ComShift::declaration() const {
  static const Declaration kDeclaration{
      "com_shift",
      "a centre of mass that is not where it was stated",
      "centre of mass + (x, y, z)",
      "Atkeson, An and Hollerbach, Estimation of inertial parameters of manipulator loads and links, Int. J. "
      "of Robotics Research 5(3), 1986",
      {Place::body},
      {any("x", "m", "shift along x of the body frame"), any("y", "m", "shift along y of the body frame"),
       any("z", "m", "shift along z of the body frame")},
      {},
      ""};
  return kDeclaration;
}

Values ComShift::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  // The lever whose weight matters as much as the driving force; at most a metre, at least a millimetre.
  const double shift = std::clamp(s.force / (s.inertia * kStandardGravity), 1e-3, 1.0);
  return {shift, shift, shift};
}

std::vector<Values> ComShift::starts(const Scales& /*scales*/) const { return {null_values()}; }

StructureChange ComShift::change(const double* p) const {
  StructureChange result;
  result.com_shift = {p[kX], p[kY], p[kZ]};
  return result;
}

}  // namespace plumbline::effects
