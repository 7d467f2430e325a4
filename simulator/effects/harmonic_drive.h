// A strain wave gear: soft while its windup is small, stiff beyond.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f = -(stiffness_soft s + stiffness_stiff (x - s) + damping v)                 [N m or N]
/// s = min(max(x, -windup), windup)
/// x, v: stretch of the ratio and its rate, felt at the motor [rad or m and /s]. Data sheets of strain wave
/// gears give stiffness by pieces at the output (K1 below the torque T1, K2 above): at a ratio N that is
/// stiffness_soft = K1/N^2, stiffness_stiff = K2/N^2, windup = N T1/K1. Both stiffnesses alike:
/// cable_stretch. Null when stiffness_soft is infinite: the ratio is rigid. Stored energy: stiffness_soft
/// s^2/2 + stiffness_soft windup d + stiffness_stiff d^2/2, d = |x| - windup beyond the windup. Its kinematic
/// error of two waves a turn of the wave generator is a wave of the reading (encoder_eccentricity, waves = 2)
/// and one of torque (cogging, cycles = 2). Source: Tuttle and Seering, A nonlinear model of a harmonic drive
/// gear transmission, IEEE Trans. Robotics and Automation 12(3) (1996), pages 368-374.
class HarmonicDrive final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
  double dissipated_power(const Motion& m, const double* state, const double* p) const override;
  void switches(const Motion& m, const double* p, std::vector<double>& g) const override;
};

}  // namespace plumbline::effects
