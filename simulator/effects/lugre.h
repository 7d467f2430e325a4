// LuGre friction: bristles that deflect before the surfaces slide.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// f     = -(stiffness z + bristle_damping dz/dt + viscous v)               [N m or N]
/// dz/dt = v - stiffness |v| / g z,  z: mean bristle deflection (state "bristle"), rad or m
/// g     = level + rise exp(-(v / stribeck_speed)^2)
/// Stored energy: stiffness z^2 / 2.
///
/// Lost power, for |z| <= (level + rise)/stiffness (a set that the state never leaves), is not negative when
/// viscous >= bristle_damping rise / level (Barabanov and Ortega 2000); see the declaration's power note.
/// Without level and rise the bristles carry nothing: they are then frozen and only the viscous term is left.
/// Source: Canudas de Wit, Olsson, Astrom and Lischinsky, IEEE Trans. Automatic Control 40 (1995),
/// section II; Park et al. (2011), equations 31 and 32.
class LuGre final : public ForceLaw {
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
