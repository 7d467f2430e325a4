// Derivations. Gravity is (-g sin tilt, -g cos tilt) in the plane (x to the right, z up).
//
// Pendulum. The arm turns by p about +y: its centre of mass, (d, -c) in the hanging arm, is at
//   x = d cos p - c sin p, z = -d sin p - c cos p,
// V = m (g cos tilt z + g sin tilt x), T = J p'^2 / 2.
//
// Leg. Axes along -y: a link at absolute angle q has its centre of mass at c e(q) + d n(q) from its pivot,
// with e = (sin q, -cos q), n = (cos q, sin q). Thigh angle a = p0 + p1, shin angle b = p0 - p1, the spring's
// bar turns by 2 p1, the shin's bar by b. The knee is at L e(a). Kinetic energy
//   T = (J_t + m_s L^2) a'^2/2 + J_s b'^2/2 + h a' b' + J_sp (2 p1')^2/2 + J_cs b'^2/2,
//   h(D) = m_s L (c_s cos D + d_s sin D), D = a - b = 2 p1.
// In p: a' = p0' + p1', b' = p0' - p1', hence with A = J_t + m_s L^2, B = J_s + J_cs
//   M00 = A + B + 2 h, M01 = A - B, M11 = A + B - 2 h + 4 J_sp.
// h depends on p1 alone: k = dh/dp1 = 2 h'(D). Lagrange's terms of T = h (p0'^2 - p1'^2) + constants:
//   d/dt dT/dp0' = ... + 2 k p1' p0';   d/dt dT/dp1' - dT/dp1 = ... - 2 k p1'^2 - k (p0'^2 - p1'^2)
//                                                             = ... - k (p0'^2 + p1'^2).
//
// Cart. At s along the way x = s cos incline, z = s sin incline, V = m g (cos tilt z + sin tilt x).
//
// Hopper. Slides along z: body at y, carriage at y - s, foot at y - s + c.
#include "tests/battery/worlds/equations.h"

#include <cmath>

namespace plumbline::battery::worlds {
namespace {

/// dV/dq of a hanging link over its pivot's height, axis along -y: V = m (g_z z + g_x x).
double weight_moment(const Rig& rig, const Link& link, double q) {
  const double up = rig.gravity * std::cos(rig.tilt);
  const double side = rig.gravity * std::sin(rig.tilt);
  // z = -c cos q + d sin q, x = c sin q + d cos q
  return link.mass * (up * (link.along * std::sin(q) + link.across * std::cos(q)) +
                      side * (link.along * std::cos(q) - link.across * std::sin(q)));
}

}  // namespace

void pendulum_equations(const Rig& rig, const Vector& p, const Vector& /*rate*/, Matrix& mass, Vector& bias) {
  const Link& arm = rig.bodies.front();
  const double up = rig.gravity * std::cos(rig.tilt);
  const double side = rig.gravity * std::sin(rig.tilt);
  mass(0, 0) = arm.about_pivot();
  bias[0] = arm.mass * (up * (arm.along * std::sin(p[0]) - arm.across * std::cos(p[0])) -
                        side * (arm.along * std::cos(p[0]) + arm.across * std::sin(p[0])));
}

void leg_bench_equations(const Rig& rig, const Vector& p, const Vector& rate, Matrix& mass, Vector& bias) {
  const Link& thigh = rig.bodies[0];
  const Link& shin = rig.bodies[1];
  const Link& spring_bar = rig.bodies[2];
  const Link& shin_bar = rig.bodies[3];
  const double L = rig.length;
  const double D = 2.0 * p[1];
  const double h = shin.mass * L * (shin.along * std::cos(D) + shin.across * std::sin(D));
  const double k = 2.0 * shin.mass * L * (shin.across * std::cos(D) - shin.along * std::sin(D));
  const double A = thigh.about_pivot() + shin.mass * L * L;
  const double B = shin.about_pivot() + shin_bar.about_pivot();
  mass(0, 0) = A + B + 2.0 * h;
  mass(0, 1) = mass(1, 0) = A - B;
  mass(1, 1) = A + B - 2.0 * h + 4.0 * spring_bar.about_pivot();
  const double a = p[0] + p[1];
  const double b = p[0] - p[1];
  const Link knee{"", shin.mass, L, 0.0, 0.0};  // the shin's mass as it hangs from the thigh
  const double of_thigh = weight_moment(rig, thigh, a) + weight_moment(rig, knee, a);
  const double of_shin = weight_moment(rig, shin, b) + weight_moment(rig, shin_bar, b);
  bias[0] = 2.0 * k * rate[0] * rate[1] + of_thigh + of_shin;
  bias[1] = -k * (rate[0] * rate[0] + rate[1] * rate[1]) + of_thigh - of_shin +
            2.0 * weight_moment(rig, spring_bar, D);
}

void hopper_equations(const Rig& rig, const Vector& /*p*/, const Vector& /*rate*/, Matrix& mass,
                      Vector& bias) {
  const double body = rig.bodies[0].mass;
  const double slider = rig.bodies[1].mass;
  const double foot = rig.bodies[2].mass;
  mass << body + slider + foot, -(slider + foot), foot,  //
      -(slider + foot), slider + foot, -foot,            //
      foot, -foot, foot;
  const double up = rig.gravity * std::cos(rig.tilt);
  bias[0] = up * (body + slider + foot);
  bias[1] = -up * (slider + foot);
  bias[2] = up * foot;
}

void cart_equations(const Rig& rig, const Vector& /*p*/, const Vector& /*rate*/, Matrix& mass, Vector& bias) {
  mass(0, 0) = rig.bodies.front().mass;
  bias[0] = rig.bodies.front().mass * rig.gravity * std::sin(rig.incline + rig.tilt);
}

}  // namespace plumbline::battery::worlds
