#include "simulator/effects/bus_delay.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDelay };

}  // namespace

const Declaration& BusDelay::declaration() const {
  static const Declaration kDeclaration{
      "bus_delay",
      "commands of all motors of a limb, or of the robot, that take effect later",
      "torque(t) = u(t - delay) of every motor there",
      "Tindell, Burns and Wellings, Control Engineering Practice 3(8), 1995, section 3 (from queueing to "
      "arrival on a CAN bus)",
      {Place::limb},
      {non_negative("delay", "s", "time between commands and effect")},
      {},
      ""};
  return kDeclaration;
}

Values BusDelay::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position / s.velocity};
}

std::vector<Values> BusDelay::starts(const Scales& /*scales*/) const { return {null_values()}; }

double BusDelay::torque(double commanded, const double* /*state*/, const double* /*p*/) const {
  return commanded;
}

double BusDelay::delay(const double* p) const { return p[kDelay]; }

}  // namespace plumbline::effects
