// A winding under a voltage: its inductance delays the torque, and the back EMF with it.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = delivered - load                                                    [N m or N], state "delivered"
/// d delivered/dt = (load - slope v - delivered) / time_constant
/// load: torque that the voltage would give at rest in the end, K U/R, which is what a command in volt asks
/// for. The circuit is L di/dt + R i + K v = U with delivered = K i: time_constant = L/R [s], slope = K^2/R
/// [N m s/rad or N s/m]. Behind a current controller it is not seen (current_loop is what is left of it).
/// Null when time_constant = 0: then the back EMF is viscous friction and has that name. Without a slope it
/// is actuator_lag. A short one is about actuator_lag, viscous and a rotor lighter by slope time_constant.
/// Power comes from the supply and goes back to it: loss in the copper and field are the supply's account.
/// Source: Fitzgerald, Kingsley and Umans, Electric Machinery (6th edition, 2003), chapter 11
/// (armature-controlled motor).
class Winding final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  void state_rate(const Motion& m, const double* state, const double* p, double* rate) const override;
};

}  // namespace plumbline::effects
