#include "simulator/effects/bus_delay.h"

#include "simulator/effects/parameters.h"

namespace plumbline::effects {

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

}  // namespace plumbline::effects
