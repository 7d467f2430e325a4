// Coulomb friction of a point foot on the ground, smooth at standstill.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/contact_law.h"

namespace plumbline::contact {

/// force = -normal (friction tanh(|v| / slip_speed) / |v| + viscous) v                                 [N]
/// v: slip, m/s, a vector of the ground's plane, |v| the Euclidean norm; friction: coefficient, 1;
/// slip_speed, m/s; viscous: rise of the coefficient with speed, s/m. At v = 0 the quotient is friction /
/// slip_speed.
///
/// With lateral < 1 only that share of the slip across the foot (its y) is felt, and that share of the force
/// comes back, as in ground_friction.h.
///
/// Source: Andersson, Soderberg and Bjorklund, Tribology International 40, 2007, 580-587, who compare this
/// form with others; with the direction of a plane's slip in place of a line's sign.
///
/// No state, nothing stored. It does not hold: under a load |f| < friction normal a foot creeps with
/// slip_speed atanh(|f| / (friction normal)). Simulators without bristles have this or a straight line below
/// slip_speed. Where a foot is to stand still, ground_friction does.
///
/// Energy: lost power = normal (friction |v| tanh(|v| / slip_speed) + viscous |v|^2), never negative.
class GroundCoulomb final : public TangentialLaw {
 public:
  const effects::Declaration& declaration() const override;
  effects::Values typical(const effects::Scales& scales) const override;
  std::vector<effects::Values> starts(const effects::Scales& scales) const override;
  bool is_isotropic(const double* p) const override;

  Eigen::Vector2d force(const Eigen::Vector2d& slip, double normal, const double* state,
                        const double* p) const override;
  double dissipated_power(const Eigen::Vector2d& slip, double normal, const double* state,
                          const double* p) const override;
  void apply(const GroundChange& change, double* p) const override;
};

}  // namespace plumbline::contact
