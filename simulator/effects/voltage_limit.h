// A bus voltage that bounds what a winding can give: torque falls with speed.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = min(max(load, -stall_torque - slope v), stall_torque - slope v) - load      [N m or N]
/// slope = stall_torque / no_load_speed; load: torque that the amplifier is asked for.
/// A winding of resistance R, torque constant K and back EMF K v takes the current load/K as long as the bus
/// has the voltage R load/K + K v for it: between -U and U. Hence stall_torque = K U / R [N m or N] and
/// no_load_speed = U / K [rad/s or m/s], as data sheets have them; from R and K: slope = K^2 / R.
/// The force is what the torque falls short by. Inductance is neglected (it matters below about L/R).
/// An infinite no_load_speed leaves a limit of torque alone.
/// Source: Fitzgerald, Kingsley and Umans, Electric Machinery (6th edition, 2003), section 7.4 (speed against
/// torque of a permanent-magnet machine at constant voltage).
class VoltageLimit final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
};

}  // namespace plumbline::effects
