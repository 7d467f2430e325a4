// A compliant, damped ground under a point foot.
#pragma once

#include <vector>

#include "contact/contact_law.h"

namespace plumbline::contact {

/// normal = max(0, s^exponent (stiffness + damping r + root_damping sgn(r) R(r)))   [N],
///          R(r) = sqrt((|r| + rounding) / root_speed) - sqrt(rounding / root_speed),
///          where depth > 0, else 0
/// s = depth / reference_depth; r: rate of the depth, m/s. Stored energy, J:
///          stiffness reference_depth s^(exponent + 1) / (exponent + 1).
///
/// Source: Park et al. (2011), equation 29 and Table VIII: k = 4.38e7, lambda_a = 3.0e6, lambda_b = 4.5e6,
/// n = 1.5 (a spherical foot). Two readings of ours:
/// - With z_G as the paper words it (penetration depth) both damping terms of equation 29 would push a foot
///   that moves in further in, and so add energy. Here they oppose the motion.
/// - k is printed in N/m^1.5, a unit that changes with the exponent and that udunits2 takes for "5 N/m".
///   reference_depth (1 m) and root_speed (1 m/s) keep the table's numbers and give them whole units.
///
/// The ground does not pull: where a foot leaves faster than the ground follows, the force is 0 and what is
/// still stored is lost. Without the root term that needs r < -stiffness/damping, which no free rebound
/// reaches (Marhefka and Orin 1999).
///
/// Without rounding (the law as printed) the root term has an infinite slope at r = 0: no derivative can be
/// taken there (switch r), and an implicit integrator makes no headway on a standing foot. It ends
/// the bouncing of a standing foot in finite time, as the paper says. The depth itself then creeps to rest
/// as 1/t: near the rest depth spring and root balance, r = -(spring force/root_damping s^exponent)^2, and
/// only two exceptional motions arrive in finite time (Vazquez, ESAIM: COCV 9, 2003, 231-246). With Table
/// VIII and 65 kg what is left after 0.1 s of it is 2e-8 m.
///
/// Smooth between its switches: the depth (the force itself is continuous there), r in the ground where
/// there is a root term, and the bracket, whose sign is the ground's wish to pull.
class GroundNormal final : public NormalLaw {
 public:
  const effects::Declaration& declaration() const override;
  effects::Values typical(const effects::Scales& scales) const override;
  std::vector<effects::Values> starts(const effects::Scales& scales) const override;

  double force(double depth, double rate, const double* p) const override;
  double stored_energy(double depth, const double* p) const override;
  double dissipated_power(double depth, double rate, const double* p) const override;
  void switches(double depth, double rate, const double* p, std::vector<double>& g) const override;
  void apply(const GroundChange& change, double* p) const override;
};

}  // namespace plumbline::contact
