// A coupling that slips: an elastic ratio whose torque is capped.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -(stiffness windup + damping windup_rate)                         [N m or N], state "windup"
/// d windup/dt = v - |r|^8 (v + |v| sgn(r)) / 2,  r = stiffness windup / limit        [rad/s or m/s]
/// v: rate of the ratio's stretch, all felt at the motor. A damped spring until its torque comes near the
/// limit, where the windup stays and the coupling slips: the position that motor and link have lost against
/// each other does not come back. Unloaded it is a spring again (Bouc and Wen with beta = gamma = 1/2; the
/// power 8 makes it nearly elastic and perfectly plastic). |r| <= 1 is never left.
/// Null when limit is infinite: the ratio is rigid. Stored energy: stiffness windup^2 / 2; lost: stiffness
/// windup (v - windup_rate) + damping windup_rate v.
/// Source: Wen, Method for random vibration of hysteretic systems, ASCE J. Engineering Mechanics Division
/// 102(2) (1976), pages 249-263.
class SlippingCoupling final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
  double dissipated_power(const Motion& m, const double* state, const double* p) const override;
  void state_rate(const Motion& m, const double* state, const double* p, double* rate) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
};

}  // namespace plumbline::effects
