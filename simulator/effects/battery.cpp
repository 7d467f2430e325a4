#include "simulator/effects/battery.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kStallSag, kSpeedSag };

}  // namespace

const Declaration& Battery::declaration() const {
  static const Declaration kDeclaration{
      "battery",
      "a battery with an inner resistance: all motors lose voltage by what all of them draw",
      "torque of every motor = share*u; share = (1 + speed_sag*sum(u*v))/(1 + stall_sag*sum(u^2)), sums over "
      "all motors",
      "Linden and Reddy, Handbook of Batteries, 3rd edition, 2002, chapter 3 (ohmic drop); Hughes and "
      "Drury, Electric Motors and Drives, 4th edition, 2013, chapter 3 (armature circuit)",
      {Place::world},
      {non_negative("stall_sag", "1/({force})^2",
                    "share of the voltage lost per square of torque at rest, of motors alike"),
       non_negative("speed_sag", "1/W", "share of the voltage won back per power of the back EMF")},
      {},
      ""};
  return kDeclaration;
}

Values Battery::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {1.0 / (s.force * s.force), 1.0 / (s.force * s.velocity)};
}

std::vector<Values> Battery::starts(const Scales& /*scales*/) const { return {null_values()}; }

double Battery::share(const double* torques, const double* speeds, int motors, const double* p) const {
  double squares = 0.0;
  double power = 0.0;
  for (int m = 0; m < motors; ++m) {
    squares += torques[m] * torques[m];
    power += torques[m] * speeds[m];
  }
  return (1.0 + p[kSpeedSag] * power) / (1.0 + p[kStallSag] * squares);
}

}  // namespace plumbline::effects
