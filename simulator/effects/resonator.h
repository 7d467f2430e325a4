// A mass on a spring on a link: what rattles, sloshes or swings along.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f       = inertia w (w stretch + 2 damping_ratio (speed - v)),  w = 2 pi frequency    [N m or N]
/// d stretch/dt = speed - v                         [rad or m]: state "stretch", of the spring
/// d speed/dt   = -w (w stretch + 2 damping_ratio (speed - v))  [rad/s^2 or m/s^2]: state "speed", of the
/// mass The mass rides along one coordinate of the robot; only its inertia is added, its weight is the link's
/// (payload). Below its frequency it is carried along as a rotor inertia would be, at its frequency it takes
/// out motion, above it stands still.
/// Stored energy: inertia (w^2 stretch^2 + speed^2) / 2; lost: 2 damping_ratio w inertia (speed - v)^2.
/// Source: Den Hartog, Mechanical Vibrations (4th edition, 1956), section 3.2 (the dynamic absorber),
/// equations of motion 3.9 with the main spring left out.
class Resonator final : public ForceLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  double force(const Motion& m, const double* state, const double* p) const override;
  double stored_energy(const Motion& m, const double* state, const double* p) const override;
  double dissipated_power(const Motion& m, const double* state, const double* p) const override;
  void state_rate(const Motion& m, const double* state, const double* p, double* rate) const override;
};

}  // namespace plumbline::effects
