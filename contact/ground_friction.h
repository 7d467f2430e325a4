// LuGre friction of a point foot on the ground, per unit normal force.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/contact_law.h"

namespace plumbline::contact {

/// force = -normal (bristle_stiffness d + bristle_damping dd/dt + viscous v)                            [N]
/// dd/dt = v - bristle_stiffness |v| / friction d      where normal > 0
///       = -d / relaxation                             where normal = 0
/// v: slip, m/s; d: mean bristle deflection, m (states "bristle_x", "bristle_y"); both vectors of the
/// ground's plane, |v| the Euclidean norm: no direction is preferred while lateral is 1. Stored energy:
/// normal bristle_stiffness |d|^2/2.
///
/// With lateral < 1 the bristles see only that share of the slip across the foot (its y), and that share of
/// their force comes back: force . slip, and with it every statement on energy below, stays as it is for the
/// slip that is seen. 0 is a foot that rolls or gives sideways, as a robot on a boom needs: its legs lean
/// with the boom's pitch.
///
/// Source: Park et al. (2011), equations 30 to 32, with a force that opposes the slip. mu of equation 32 is a
/// number, so sigma_0 is in 1/m, sigma_1 and alpha_2 are in s/m and alpha_0 in 1; the N/m, N s/m and N of
/// Table VIII cannot be. The vector form: Velenis, Tsiotras, Canudas de Wit and Sorine, Vehicle System
/// Dynamics 43(1), 2005.
///
/// In the air. Equation 31 by itself would let the bristles follow the swinging foot, so that a foot touched
/// down with its friction spent against the swing. Here unloaded bristles straighten with the time constant
/// `relaxation`, short beside a flight and no stiffer than the contact. That costs no energy: unloaded
/// bristles store none. The deflection is continuous; its rate jumps where the normal force starts or ends,
/// which are zeros of the normal law's switches. There is a kink of |v| at slip 0, a switch only for a foot
/// that moves in one line (in the plane the slip passes it by).
///
/// Energy. |d| <= friction/bristle_stiffness is never left. With e = v/|v| and
/// s = bristle_stiffness d/friction, at constant normal force
///   lost power = normal |v| (friction |s|^2 + |v| (bristle_damping (1 - s . e) + viscous)),
/// which for |s| <= 1 is not negative, whatever the values. (From outside that range it is so for all d only
/// up to |v| = 4 friction (bristle_damping + viscous)/bristle_damping^2.) Where the normal force changes,
///   force . slip = - d(stored_energy)/dt - lost power + stored_energy d(normal)/dt / normal:
/// a load that rises on bent bristles stiffens them and gives energy that nothing pays for, at most
/// friction^2/(2 bristle_stiffness) joules for each newton; a load that falls takes it back. A run that
/// must balance takes -force . slip as lost and counts no stored energy.
///
/// Creep. Under a constant load below friction the foot comes to rest and stays. Under a load that shakes it
/// creeps, as LuGre does (Dupont, Hayward, Armstrong and Altpeter, IEEE Trans. Automatic Control 47(5),
/// 2002): by about |s|, the share of the friction that is used, of the path that the vibration covers.
class GroundFriction final : public TangentialLaw {
 public:
  const effects::Declaration& declaration() const override;
  effects::Values typical(const effects::Scales& scales) const override;
  std::vector<effects::Values> starts(const effects::Scales& scales) const override;
  bool is_null(const double* p) const override;
  bool is_isotropic(const double* p) const override;

  Eigen::Vector2d force(const Eigen::Vector2d& slip, double normal, const double* state,
                        const double* p) const override;
  void state_rate(const Eigen::Vector2d& slip, double normal, const double* state, const double* p,
                  double* rate) const override;
  double stored_energy(double normal, const double* state, const double* p) const override;
  double dissipated_power(const Eigen::Vector2d& slip, double normal, const double* state,
                          const double* p) const override;
  void apply(const GroundChange& change, double* p) const override;
};

}  // namespace plumbline::contact
