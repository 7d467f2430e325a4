// Friction of a foot that rolls or spins on the ground.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "contact/contact_law.h"

namespace plumbline::contact {

/// Moment of the ground on a foot that turns. Power balance at constant normal force:
///   moment . turn = -dissipated power, never positive.
/// Its parameters are a length, by which the normal force makes the moment, and the turn below which it
/// fades.
class TurningLaw : public effects::Law {
 public:
  /// ON the foot, N m; turn: angular velocity of its link, rad/s; both in axes whose third is the ground's
  /// normal. normal: the normal law's force, N, not negative.
  virtual Eigen::Vector3d moment(const Eigen::Vector3d& turn, double normal, const double* p) const = 0;
  effects::Values typical(const effects::Scales& scales) const override;
  std::vector<effects::Values> starts(const effects::Scales& scales) const override;
};

/// moment = -normal arm tanh(|w| / roll_speed) w / |w|, w the turn along the plane                    [N m]
/// arm: by how far the normal force acts ahead of the foot's centre, m; roll_speed: turn below which it
/// fades, rad/s. At w = 0 the quotient is 1 / roll_speed.
///
/// Source: Johnson, Contact Mechanics, 1985, section 9.1 (rolling resistance as a moment); the smooth sign as
/// in ground_coulomb.h.
std::shared_ptr<const TurningLaw> rolling_friction();

/// moment = -normal radius tanh(w / spin_speed) about the normal, w the turn about it                 [N m]
/// radius: moment over normal force when it spins, m: of a patch of radius a that slides with the coefficient
/// mu under an even pressure 2/3 mu a; spin_speed: turn below which it fades, rad/s.
///
/// Source: Johnson, Contact Mechanics, 1985, section 7.4 (torsion of contacting spheres); the smooth sign as
/// in ground_coulomb.h.
std::shared_ptr<const TurningLaw> spinning_friction();

}  // namespace plumbline::contact
