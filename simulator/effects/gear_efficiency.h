// A gear that loses another share of the power when it is driven backwards.
#pragma once

#include <vector>

#include "simulator/effects/dissipative_law.h"

namespace plumbline::effects {

/// f = -((loss_driving + loss_driven) |load| s + (loss_driving - loss_driven) load s^2) / 2    [N m or N]
/// s = tanh(v / smoothing_speed); load: torque that the motor's gear passes on to what it drives, this loss
/// included (see gear_friction). Away from standstill that is -loss_driving |load| sgn(v) while the motor
/// drives (load v > 0) and -loss_driven |load| sgn(v) while it is driven. With the efficiencies eta of
/// driving and eta_b of being driven: loss_driving = 1/eta - 1, loss_driven = 1 - eta_b. A worm is
/// self-locking where loss_driven is 1. With equal losses it is gear_friction. Written in s so that it has no
/// corner. Source: Wang and Kim, Directional efficiency in geared transmissions: characterization of
/// backdrivability towards improved proprioceptive control, IEEE ICRA 2015; Dohring, Lee and Newman, IEEE
/// ICRA 1993.
class GearEfficiency final : public DissipativeLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  bool feels_gear_load() const override { return true; }
};

}  // namespace plumbline::effects
