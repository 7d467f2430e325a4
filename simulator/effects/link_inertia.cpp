#include "simulator/effects/link_inertia.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kX, kY, kZ, kXy, kXz, kYz };

}  // namespace

const Declaration& LinkInertia::declaration() const {
  static const Declaration kDeclaration{
      "link_inertia",
      "an inertia tensor that is not what was stated, at the same mass and centre of mass",
      "the body's matter moved by F = [e^x 0 0; xy e^y 0; xz yz e^z] about its centre of mass",
      "Wensing, Kim and Slotine, Linear matrix inequalities for physically consistent inertial parameter "
      "identification, IEEE Robotics and Automation Letters 3(1), 2018",
      {Place::body},
      {any("x", "1", "logarithm of the stretch along x of the body frame"),
       any("y", "1", "logarithm of the stretch along y"), any("z", "1", "logarithm of the stretch along z"),
       any("xy", "1", "how far y moves with x"), any("xz", "1", "how far z moves with x"),
       any("yz", "1", "how far z moves with y")},
      {},
      ""};
  return kDeclaration;
}

Values LinkInertia::typical(const Scales& /*scales*/) const {
  constexpr double kStretch = 0.2;  // an inertia that was estimated from a drawing is off by a third
  return {kStretch, kStretch, kStretch, kStretch, kStretch, kStretch};
}

std::vector<Values> LinkInertia::starts(const Scales& /*scales*/) const { return {null_values()}; }

StructureChange LinkInertia::change(const double* p) const {
  StructureChange result;
  result.stretch << std::exp(p[kX]), 0.0, 0.0,  //
      p[kXy], std::exp(p[kY]), 0.0,             //
      p[kXz], p[kYz], std::exp(p[kZ]);
  return result;
}

}  // namespace plumbline::effects
