#include "controllers/monopod/monopod.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

namespace plumbline::monopod {
namespace {

/// How far the tip of a vector (x, z) that turns with an angle is, and its first derivative by the angle. The
/// second is the negative of the first.
struct Turned {
  Vector2 at, slope;
};

Turned turned(double x, double z, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{x * c + z * s, -x * s + z * c}, {-x * s + z * c, -x * c - z * s}};
}

/// A point that hangs from the hip by up to two turning vectors: by which absolute angles, and how.
struct Point {
  Vector2 at = Vector2::Zero();
  Matrix26 jacobian = Matrix26::Zero();
  Vector2 bias = Vector2::Zero();
};

// Rows: torso, thigh, shin; columns: leg angle, leg shape, torso, as multiples of their rates.
constexpr int kAngles[3][3] = {{0, 0, 1}, {1, 1, 1}, {1, -1, 1}};

void hang(Point& point, int link, const Turned& vector, double rate) {
  point.at += vector.at;
  point.jacobian.col(kLegAngle) += kAngles[link][0] * vector.slope;
  point.jacobian.col(kLegShape) += kAngles[link][1] * vector.slope;
  point.jacobian.col(kTorso) += kAngles[link][2] * vector.slope;
  point.bias -= rate * rate * vector.at;
}

struct Points {
  Point torso, thigh, shin, toe;
  double rates[3];
};

Points points(const Constants& c, const State& state) {
  const Vector6 &q = state.q, &v = state.v;
  double angles[3];
  Points p;
  for (int i = 0; i < 3; ++i) {
    angles[i] = kAngles[i][0] * q[kLegAngle] + kAngles[i][1] * q[kLegShape] + kAngles[i][2] * q[kTorso];
    p.rates[i] = kAngles[i][0] * v[kLegAngle] + kAngles[i][1] * v[kLegShape] + kAngles[i][2] * v[kTorso];
  }
  for (Point* point : {&p.torso, &p.thigh, &p.shin, &p.toe}) {
    point->at << q[kHipX], q[kHipZ];
    point->jacobian(0, kHipX) = point->jacobian(1, kHipZ) = 1.0;
  }
  hang(p.torso, 0, turned(c.torso.x, c.torso.z, angles[0]), p.rates[0]);
  hang(p.thigh, 1, turned(c.thigh.x, c.thigh.z, angles[1]), p.rates[1]);
  const Turned knee = turned(0.0, -c.upper_length, angles[1]);
  hang(p.shin, 1, knee, p.rates[1]);
  hang(p.shin, 2, turned(c.shin.x, c.shin.z, angles[2]), p.rates[2]);
  hang(p.toe, 1, knee, p.rates[1]);
  hang(p.toe, 2, turned(0.0, -c.lower_length, angles[2]), p.rates[2]);
  return p;
}

/// The row that gives B_Spring's turn.
Vector6 spring_row(const Constants& c) {
  Vector6 row = Vector6::Zero();
  row[kLegShape] = c.spring_ratio;
  row[kMotor] = -c.spring_ratio / c.shape_ratio;
  return row;
}

template <int N>
void finish(const Dynamics& d, Reduced<N>& r) {
  const Eigen::Matrix<double, N, N> mass = r.s.transpose() * d.mass * r.s;
  r.inverse_st = mass.llt().solve(r.s.transpose());
}

}  // namespace

double total_mass(const Constants& c) { return c.torso.mass + c.thigh.mass + c.shin.mass; }

double deflection(const Constants& c, const Vector6& q) {
  return c.spring_ratio * (q[kLegShape] - q[kMotor] / c.shape_ratio);
}

Dynamics dynamics(const Constants& c, const State& state) {
  const Points p = points(c, state);
  Dynamics d;
  d.mass.setZero();
  d.bias.setZero();
  d.com.setZero();
  d.com_jacobian.setZero();
  d.com_bias.setZero();
  const Link* links[3] = {&c.torso, &c.thigh, &c.shin};
  const Point* at[3] = {&p.torso, &p.thigh, &p.shin};
  for (int i = 0; i < 3; ++i) {
    const Matrix26& j = at[i]->jacobian;
    d.mass.noalias() += links[i]->mass * (j.transpose() * j);
    Vector6 turn = Vector6::Zero();
    turn[kLegAngle] = kAngles[i][0];
    turn[kLegShape] = kAngles[i][1];
    turn[kTorso] = kAngles[i][2];
    d.mass.noalias() += links[i]->inertia * (turn * turn.transpose());
    d.bias.noalias() += links[i]->mass * (j.transpose() * (at[i]->bias + Vector2(0.0, c.gravity)));
    const double share = links[i]->mass / total_mass(c);
    d.com += share * at[i]->at;
    d.com_jacobian += share * j;
    d.com_bias += share * at[i]->bias;
  }
  // Rotors and pulleys turn relative to the torso; its own rate adds nothing to their energy.
  d.mass(kLegAngle, kLegAngle) += c.angle_inertia * c.angle_ratio * c.angle_ratio;
  d.mass(kMotor, kMotor) += c.shape_inertia;
  const Vector6 spring = spring_row(c);
  d.mass.noalias() += c.spring_inertia * (spring * spring.transpose());
  d.bias += spring * (c.spring_stiffness * deflection(c, state.q) + c.spring_preload +
                      c.spring_damping * spring.dot(state.v));
  d.bias[kLegAngle] += c.angle_friction * c.angle_ratio * c.angle_ratio * state.v[kLegAngle];
  d.bias[kMotor] += c.shape_friction * state.v[kMotor];
  d.input.setZero();
  d.input(kLegAngle, 0) = c.angle_ratio;
  d.input(kMotor, 1) = 1.0;
  d.toe = p.toe.at;
  d.toe_jacobian = p.toe.jacobian;
  d.toe_bias = p.toe.bias;
  return d;
}

double energy(const Constants& c, const State& state) {
  const Dynamics d = dynamics(c, state);
  const double bend = deflection(c, state.q);
  return 0.5 * state.v.dot(d.mass * state.v) + total_mass(c) * c.gravity * d.com[1] +
         0.5 * c.spring_stiffness * bend * bend + c.spring_preload * bend;
}

Reduced<4> stance(const Dynamics& d) {
  Reduced<4> r;
  r.s.setZero();
  r.gamma.setZero();
  for (int i = 0; i < 4; ++i) {
    r.s(i, i) = 1.0;
  }
  r.s.template bottomRows<2>() = -d.toe_jacobian.template leftCols<4>();
  r.gamma.template tail<2>() = -d.toe_bias;
  finish(d, r);
  return r;
}

Reduced<5> flight(const Constants& c, const Dynamics& d) {
  Reduced<5> r;
  r.s.setZero();
  r.gamma.setZero();
  r.s(kLegAngle, 0) = r.s(kLegShape, 1) = r.s(kTorso, 2) = r.s(kHipX, 3) = r.s(kHipZ, 4) = 1.0;
  r.s(kMotor, 1) = c.shape_ratio;
  finish(d, r);
  return r;
}

Vector2 ground_force(const Dynamics& d, const Vector6& acceleration) {
  return (d.mass * acceleration + d.bias).tail<2>();
}

void stand_on_origin(const Constants& c, State& state, bool also_velocity) {
  state.q.tail<2>().setZero();
  const Dynamics d = dynamics(c, state);
  state.q.tail<2>() = -d.toe;
  if (also_velocity) {
    state.v.tail<2>() = -d.toe_jacobian.leftCols<4>() * state.v.head<4>();
  }
}

}  // namespace plumbline::monopod
