// A motor that weakens as it warms.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// torque = u (1 - magnet_sag (housing - ambient)) / (1 + copper_sag (winding - ambient))       [N m or N]
/// d winding/dt = heating u^2 (1 + copper (winding - ambient)) - (winding - housing) / winding_time    [K/s]
/// d housing/dt = (share (winding - housing)) / winding_time - (housing - ambient) / housing_time      [K/s]
/// Two thermal masses: the copper, heated by the current i = u/K with R i^2, and the housing with the
/// magnets. States "winding_temperature" and "housing_temperature", K; both at ambient when a record begins.
/// heating = R / (K^2 C_w) with resistance R, torque constant K and the winding's heat capacity C_w, J/K;
/// winding_time = R_wh C_w with the thermal resistance R_wh between both; share = C_w / C_h; housing_time =
/// R_ha C_h to the surroundings. Data sheets have them. copper: of its resistance, 0.39 %/K.
/// magnet_sag: of the magnets, 0.1 to 0.2 %/K. copper_sag: 0.39 %/K where an amplifier sets the voltage, 0
/// where it sets the current. Null when both sags are 0. Source: Hughes and Drury, Electric Motors and Drives
/// (4th edition, 2013), section 11.2 (heating); Wallscheid and Boecker, IEEE Trans. Industry Applications
/// 52(2) (2016) (networks of thermal masses).
class ThermalMotor final : public ActuatorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double torque(double commanded, const double* state, const double* p) const override;
  void state_rate(double commanded, const double* state, const double* p, double* rate) const override;
  /// At ambient, whatever is commanded: a record begins with a cold motor.
  void settle(double commanded, const double* p, double* state) const override;
};

}  // namespace plumbline::effects
