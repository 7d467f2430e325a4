// Commands of several motors that take effect later, all alike: one bus carries them.
#pragma once

#include "simulator/effects/command_delay.h"

namespace plumbline::effects {

/// torque(t) = u(t - delay)  of every motor of a limb, or of the robot      [N m or N], delay in s
/// Commands that travel on one bus (CAN, EtherCAT) or come out of one controller are late together; where
/// only one motor's is, it is a command_delay, which this is of each. Null at delay = 0.
/// Source: Tindell, Burns and Wellings, Control Engineering Practice 3(8), 1995, section 3 (time from
/// queueing to arrival on a CAN bus).
class BusDelay final : public CommandDelay {
 public:
  const Declaration& declaration() const override;
};

}  // namespace plumbline::effects
