#include "controllers/monopod/running.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace plumbline::monopod {
namespace {

constexpr double kLeastSpan = 0.02;      // rad of theta: a shorter polynomial would ask for endless torques
constexpr double kLeastTravel = 0.01;    // m
constexpr double kLeastThetaRate = 0.1;  // rad/s
constexpr double kLeastDecoupling = 1e-9;

double at_least(double value, double least) { return value > least ? value : least; }

/// Begins where the robot is, at its rate, and ends at `end`. In between the nominal coefficients are moved
/// along: by the whole difference at the beginning, by none of it at the end.
void bend(Coefficients& a, const Coefficients& nominal, double start, double slope, double end) {
  const double off_start = start - nominal[0], off_end = end - nominal[kOrder];
  for (std::size_t k = 0; k <= kOrder; ++k) {
    const double share = static_cast<double>(k) / kOrder;
    a[k] = nominal[k] + (1.0 - share) * off_start + share * off_end;
  }
  a[0] = start;
  a[1] = start + slope / kOrder;
  a[kOrder] = end;
}

}  // namespace

Section section_of(const Constants& c, const State& state) {
  const Vector2 speed = dynamics(c, state).com_jacobian * state.v;
  Section x;
  x << state.q[kLegAngle], state.q[kLegShape], state.q[kTorso], state.v[kLegAngle], state.v[kLegShape],
      state.v[kTorso], speed;
  return x;
}

void Running::touch_down(const State& before, const State& after) {
  beta_ = gait_.beta + gait_.shift + gait_.gain * (section_of(constants_, before) - gait_.section);
  phase_ = Phase::compression;
  motor_hold_ = after.q[kMotor];
  torso_begin_ = theta(after.q);
  torso_end_ = at_least(gait_.theta_max, torso_begin_ + kLeastSpan);
  const double span = torso_end_ - torso_begin_;
  const double rate = at_least(after.v[kLegAngle] + after.v[kTorso], kLeastThetaRate);
  Coefficients nominal;
  nominal.fill(gait_.beta[0]);
  nominal[0] = gait_.torso_start;
  nominal[2] = gait_.torso_2;
  nominal[3] = gait_.torso_3;
  bend(torso_, nominal, after.q[kTorso], after.v[kTorso] / rate * span, beta_[0]);
  torso_[4] = torso_[5] = beta_[0];  // it arrives with neither slope nor curvature
}

void Running::inject(const State& state) {
  phase_ = Phase::injection;
  motor_begin_ = theta(state.q);
  motor_end_ = at_least(gait_.theta_max, motor_begin_ + 0.5 * gait_.injection_span);
  const double rate = at_least(state.v[kLegAngle] + state.v[kTorso], kLeastThetaRate);
  const double start = state.q[kMotor];
  const double step = state.v[kMotor] / rate * (motor_end_ - motor_begin_) / kOrder;
  motor_ = {
      start,    start + step, start + 2.0 * step, start + gait_.motor_middle * (beta_[1] - start), beta_[1],
      beta_[1], beta_[1]};
}

void Running::lift_off(const State& state, double height) {
  phase_ = Phase::flight;
  const Dynamics d = dynamics(constants_, state);
  const Vector2 speed = d.com_jacobian * state.v;
  const double fall = speed[1] * speed[1] + 2.0 * constants_.gravity * (height - gait_.touchdown_height);
  const double duration = (speed[1] + std::sqrt(std::max(0.0, fall))) / constants_.gravity;
  travel_begin_ = d.com[0];
  travel_ = at_least(speed[0] * duration, kLeastTravel);
  const double per_second = travel_ / at_least(speed[0], kLeastTravel);
  const Vector2 toe_speed = d.toe_jacobian * state.v;
  bend(toe_, gait_.toe, d.com[0] - d.toe[0], (speed[0] - toe_speed[0]) * per_second, beta_[2]);
  bend(shape_, gait_.shape, state.q[kLegShape], state.v[kLegShape] * per_second, gait_.shape[kOrder]);
}

void Running::drop(const State& state, double height) {
  lift_off(state, height);
  const auto straight = [](Coefficients& a, double end) {
    for (std::size_t k = 2; k <= kOrder; ++k) {
      a[k] = end;
    }
  };
  straight(toe_, beta_[2]);
  straight(shape_, gait_.shape[kOrder]);
}

Vector2 Running::torque(const State& state, const Dynamics& d) {
  // y = c(q) - h(s(q)): y' = J v, y'' = J q'' + rest.
  Matrix26 jacobian = Matrix26::Zero();
  Vector2 rest = Vector2::Zero(), controlled;
  Curve first, second;
  Acceleration a;
  if (phase_ == Phase::flight) {
    const double s = (d.com[0] - travel_begin_) / travel_;
    const Matrix26::ConstRowXpr com = d.com_jacobian.row(0);
    const double s_rate = com.dot(state.v) / travel_;
    first = bezier(toe_, s);
    second = bezier(shape_, s);
    controlled << d.com[0] - d.toe[0], state.q[kLegShape];
    jacobian.row(0) = com - d.toe_jacobian.row(0) - first.slope / travel_ * com;
    jacobian.row(1) = -second.slope / travel_ * com;
    jacobian(1, kLegShape) += 1.0;
    rest[0] =
        d.com_bias[0] - d.toe_bias[0] - first.bend * s_rate * s_rate - first.slope / travel_ * d.com_bias[0];
    rest[1] = -second.bend * s_rate * s_rate - second.slope / travel_ * d.com_bias[0];
    a = accelerations(d, flight(constants_, d));
  } else {
    const double rate = state.v[kLegAngle] + state.v[kTorso];
    const double torso_span = torso_end_ - torso_begin_, motor_span = motor_end_ - motor_begin_;
    first = bezier(torso_, (theta(state.q) - torso_begin_) / torso_span);
    if (phase_ == Phase::compression) {
      second.value = motor_hold_;
    } else {
      second = bezier(motor_, (theta(state.q) - motor_begin_) / motor_span);
    }
    controlled << state.q[kTorso], state.q[kMotor];
    for (const int angle : {kLegAngle, kTorso}) {
      jacobian(0, angle) = -first.slope / torso_span;
      jacobian(1, angle) = -second.slope / motor_span;
    }
    jacobian(0, kTorso) += 1.0;
    jacobian(1, kMotor) += 1.0;
    rest << -first.bend * rate * rate / (torso_span * torso_span),
        -second.bend * rate * rate / (motor_span * motor_span);
    a = accelerations(d, stance(d));
  }
  wanted_ << first.value, second.value;
  y_ = controlled - wanted_;
  y_rate_ = jacobian * state.v;
  const Eigen::Matrix2d decoupling = jacobian * a.gain;
  if (!(std::abs(decoupling.determinant()) > kLeastDecoupling)) {
    return Vector2::Zero();
  }
  const double e = gait_.epsilon;
  const Vector2 asked = -gait_.kp / (e * e) * y_ - gait_.kv / e * y_rate_ - rest - jacobian * a.drift;
  return decoupling.inverse() * asked;
}

}  // namespace plumbline::monopod
