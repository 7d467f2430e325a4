// Derivation.
//
// Absolute angles a (thigh) and b (shin); e(q) = (sin q, -cos q) points along a link that hangs at q = 0,
// n(q) = de/dq = (cos q, sin q) across it, so dn/dq = -e, and (with D = a - b)
//   n(a).n(b) = cos D,   n(a).e(b) = sin b cos a - cos b sin a = -sin D.
// Centre of mass of a link with pivot P at angle q: P + c e(q) + d n(q), c = along, d = across. L = thigh
// length.
//
// Kinetic energy. Links on fixed pivots have J w^2 / 2 with J about the pivot: thigh (w = a'), C_Spring
// (w = a' - b'), C_Shin (w = b'). The shin's pivot moves with L a' n(a); its own rotation adds
// (c n(b) - d e(b)) b' at the centre of mass. Squared, with J = J_cm + m (c^2 + d^2):
//   T_shin = m L^2 a'^2 / 2 + J b'^2 / 2 + H(D) a' b',   H(D) = m L (c cos D + d sin D).
// A motor at ratio g/2 (a' +- b') with inertia I adds I g^2 (a' +- b')^2 / 8.
//
// With T = (M11 a'^2 + 2 M12 a' b' + M22 b'^2)/2:
//   M11 = J_th + m L^2 + J_sp + A + S,   M22 = J_sh + J_csh + J_sp + A + S,   M12 = H(D) - J_sp + A - S,
//   A = I_A g_A^2 / 4,   S = I_S g_S^2 / 4.
// Lagrange: d/dt(dT/da') - dT/da = M11 a'' + M12 b'' + H' (a' - b') b' - H' a' b' = ... - H' b'^2,
//           d/dt(dT/db') - dT/db = M12 a'' + M22 b'' + H' (a' - b') a' + H' a' b' = ... + H' a'^2,
//   H' = m L (-c sin D + d cos D).
//
// Potential: m g z, z = z_P - c cos q + d sin q, hence dz/dq = c sin q + d cos q; the knee is at z = -L cos
// a.
#include "tests/oracles/leg_bench_lagrangian.h"

#include <Eigen/LU>
#include <cmath>

namespace plumbline::oracles {
namespace {

/// Inertia of a motor felt at the sum or the difference of the two angles.
double reflected(const GearedMotor& motor) { return motor.inertia * motor.ratio * motor.ratio / 4.0; }

/// First moment of the weight about the pivot: d(m z)/dq.
double moment(const PendulumLink& link, double angle) {
  return link.mass * (link.along * std::sin(angle) + link.across * std::cos(angle));
}

/// m z above the pivot.
double height(const PendulumLink& link, double angle) {
  return link.mass * (-link.along * std::cos(angle) + link.across * std::sin(angle));
}

/// H(D)
double coupling(const LegBenchConstants& k, double difference) {
  return k.shin.mass * k.thigh_length *
         (k.shin.along * std::cos(difference) + k.shin.across * std::sin(difference));
}

/// dH/dD
double coupling_slope(const LegBenchConstants& k, double difference) {
  return k.shin.mass * k.thigh_length *
         (-k.shin.along * std::sin(difference) + k.shin.across * std::cos(difference));
}

Pair generalised_force(const LegBenchConstants& k, const Pair& rates, const Pair& motor_torques,
                       const Pair& viscous) {
  const Eigen::Matrix2d map = motor_map(k);
  const Pair motor_rates = map * rates;
  return map.transpose() * (motor_torques - viscous.cwiseProduct(motor_rates));
}

}  // namespace

Eigen::Matrix2d motor_map(const LegBenchConstants& k) {
  const double angle = k.leg_angle.ratio / 2.0;
  const double shape = k.leg_shape.ratio / 2.0;
  Eigen::Matrix2d map;
  map << angle, angle, shape, -shape;
  return map;
}

Eigen::Matrix2d leg_bench_mass_matrix(const LegBenchConstants& k, const Pair& angles) {
  const double motors = reflected(k.leg_angle) + reflected(k.leg_shape);
  const double knee_point = k.shin.mass * k.thigh_length * k.thigh_length;
  const double cross = coupling(k, angles[0] - angles[1]) - k.cspring.inertia + reflected(k.leg_angle) -
                       reflected(k.leg_shape);
  Eigen::Matrix2d M;
  M << k.thigh.inertia + knee_point + k.cspring.inertia + motors, cross,  //
      cross, k.shin.inertia + k.cshin.inertia + k.cspring.inertia + motors;
  return M;
}

Pair leg_bench_bias(const LegBenchConstants& k, const Pair& angles, const Pair& rates) {
  const double difference = angles[0] - angles[1];
  const double slope = coupling_slope(k, difference);
  const double cspring = moment(k.cspring, difference);
  const double knee = k.shin.mass * k.thigh_length * std::sin(angles[0]);
  const double thigh = moment(k.thigh, angles[0]) + knee + cspring;
  const double shin = moment(k.shin, angles[1]) + moment(k.cshin, angles[1]) - cspring;
  return Pair(-slope * rates[1] * rates[1] + k.gravity * thigh,
              slope * rates[0] * rates[0] + k.gravity * shin);
}

Pair leg_bench_accelerations(const LegBenchConstants& k, const Pair& angles, const Pair& rates,
                             const Pair& motor_torques, const Pair& viscous) {
  const Pair force = generalised_force(k, rates, motor_torques, viscous) - leg_bench_bias(k, angles, rates);
  return leg_bench_mass_matrix(k, angles).partialPivLu().solve(force);
}

Pair leg_bench_accelerations_locked(const LegBenchConstants& k, int free_motor, const Pair& angles,
                                    const Pair& rates, const Pair& motor_torques, const Pair& viscous) {
  // Thigh and shin move together (leg angle) or against each other (leg shape).
  const Pair direction(1.0, free_motor == 0 ? 1.0 : -1.0);
  const Pair force = generalised_force(k, rates, motor_torques, viscous) - leg_bench_bias(k, angles, rates);
  const double inertia = direction.dot(leg_bench_mass_matrix(k, angles) * direction);
  return direction * (direction.dot(force) / inertia);
}

double leg_bench_energy(const LegBenchConstants& k, const Pair& angles, const Pair& rates) {
  const double kinetic = 0.5 * rates.dot(leg_bench_mass_matrix(k, angles) * rates);
  const double knee = -k.shin.mass * k.thigh_length * std::cos(angles[0]);
  const double raised = height(k.thigh, angles[0]) + knee + height(k.shin, angles[1]) +
                        height(k.cshin, angles[1]) + height(k.cspring, angles[0] - angles[1]);
  return kinetic + k.gravity * raised;
}

LegBenchConstants mabel_left_leg() {
  LegBenchConstants k;
  k.thigh_length = 0.5;
  // Table VI: mass, r_y, -r_x (the hanging link is turned by 180 deg against the table's frame), J about the
  // joint.
  k.thigh = {3.2818, 0.1978, -0.0003110, 0.1986};
  k.shin = {1.5007, 0.1570, -0.0009671, 0.08813};
  k.cspring = {1.8987, 0.1181, -0.0009406, 0.04377};
  k.cshin = {1.6987, 0.08684, -0.0004345, 0.03223};
  // alpha_rotor J_rotor,man + pulleys (J_exp,3/alpha_torque less the rotor), to six digits.
  k.leg_angle = {-23.53, 3.61608e-4 + 1.96650e-4};
  k.leg_shape = {31.42, 8.17717e-4 + 2.99871e-4};
  return k;
}

}  // namespace plumbline::oracles
