#include "simulator/effects/payload.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kMass, kX, kY, kZ };

}  // namespace

const Declaration& Payload::declaration() const {
  static const Declaration kDeclaration{
      "payload",
      "something that hangs on a body, as a point mass: a tool, a battery, a weight",
      "mass at (x, y, z) of the body frame, beside the body's own mass and centre of mass",
      "Atkeson, An and Hollerbach, Estimation of inertial parameters of manipulator loads and links, Int. J. "
      "of Robotics Research 5(3), 1986",
      {Place::body},
      {non_negative("mass", "kg", "mass of what hangs there"),
       any("x", "m", "where it hangs, along x of the body frame"),
       any("y", "m", "where it hangs, along y of the body frame"),
       any("z", "m", "where it hangs, along z of the body frame")},
      {},
      ""};
  return kDeclaration;
}

bool Payload::is_null(const double* p) const { return p[kMass] == 0.0; }

Values Payload::typical(const Scales& scales) const {
  constexpr double kLever = 0.1;  // m: where the hand of a small robot is, and a tenth of a large one
  return {guarded(scales).inertia, kLever, kLever, kLever};
}

// Where something hangs shows only when there is something: a small load of the body, and a large one (the
// last link of an arm is often much lighter than what it carries). A search trusts each for about twice its
// mass.
std::vector<Values> Payload::starts(const Scales& scales) const {
  constexpr double kSmall = 0.3;
  constexpr double kLarge = 5.0;
  const double mass = guarded(scales).inertia;
  return {{kSmall * mass, 0.0, 0.0, 0.0}, {kLarge * mass, 0.0, 0.0, 0.0}};
}

StructureChange Payload::change(const double* p) const {
  StructureChange result;
  result.payload = p[kMass];
  result.payload_at = {p[kX], p[kY], p[kZ]};
  return result;
}

}  // namespace plumbline::effects
