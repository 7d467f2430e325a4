// A battery with an inner resistance: its voltage sags under all motors that draw on it.
#pragma once

#include <vector>

#include "simulator/effects/supply_law.h"

namespace plumbline::effects {

/// torque of every motor = share u,  share = (1 + speed_sag sum(u v)) / (1 + stall_sag sum(u^2))   [1]
/// Sums over all motors; u: torque that a motor's command gives at full voltage [N m or N], v: its speed.
/// A battery of voltage V0 and inner resistance Ri feeds amplifiers that give their motors shares d of its
/// voltage V = V0 - Ri sum(d i): u = d V0 K/R, i = (d V - K v)/R. With motors alike that is the share above,
/// exactly: speed_sag = Ri/V0^2 [1/W], a quarter of one over the most power that the battery can give, and
/// stall_sag = speed_sag R/K^2 [1/(N m)^2]. What v takes is viscous friction in the model (back EMF). A motor
/// that drives against its motion (u v > 0 takes less current, u v < 0 more) is accounted for; the battery
/// takes back what a motor that brakes gives. Behind a current controller the torque stays until the
/// voltage is used up: voltage_limit.
/// Null when both are 0. For one motor at rest it is torque_saturation (sag = 2 stall_sag, to first order).
/// Source: Linden and Reddy, Handbook of Batteries (3rd edition, 2002), chapter 3 (ohmic drop); Hughes and
/// Drury, Electric Motors and Drives (4th edition, 2013), chapter 3 (armature circuit).
class Battery final : public SupplyLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double share(const double* torques, const double* speeds, int motors, const double* p) const override;
};

}  // namespace plumbline::effects
