#include "controllers/mabel_walking/walking.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline::controllers {
namespace {

enum Signal : std::size_t { kLA = 0, kMLS = 1, kBsp = 2, kTorsoAngle = 6 };  // of the left leg; right: 3 more

std::size_t of(bool right, std::size_t signal) noexcept { return signal + (right ? 3 : 0); }

double leg_angle(const WalkLegReading& leg) noexcept { return leg.thigh + 0.5 * leg.knee; }

double below_hip(const WalkLegReading& leg, double torso) noexcept {
  return std::cos(0.5 * leg.knee) * std::cos(leg_angle(leg) + torso);
}

void require(bool holds, const char* name, double found, const char* expected) {
  if (!holds) {
    throw std::invalid_argument(std::string(name) + ": found " + std::to_string(found) + ", expected " +
                                expected);
  }
}

}  // namespace

const char* to_string(WalkFault fault) noexcept {
  switch (fault) {
    case WalkFault::none:
      return "";
    case WalkFault::leg_angle:
      return "a leg angle is at its hard stop: power off";
    case WalkFault::leg_shape:
      return "a leg shape is at its hard stop: power off";
    case WalkFault::backwards:
      return "theta is not monotonic: the robot has fallen back behind where the step began";
  }
  return "unknown";
}

Walking::Walking(const WalkConstants& constants, double period) : constants_(constants), period_(period) {
  const WalkConstants& c = constants_;
  require(period > 0.0, "period", period, "more than 0 s");
  require(c.rate_samples >= 1.0 && c.rate_samples < static_cast<double>(kLongest) &&
              c.rate_samples == std::floor(c.rate_samples),
          "rate_samples", c.rate_samples, "a whole number from 1 to 16");
  require(c.gait.theta_begin < c.gait.theta_mc && c.gait.theta_mc < c.gait.theta_sc &&
              c.gait.theta_sc < c.gait.theta_si && c.gait.theta_si < c.gait.theta_end,
          "theta_si", c.gait.theta_si, "theta_begin < theta_mc < theta_sc < theta_si < theta_end");
  require(c.angle_ratio != 0.0, "angle_ratio", c.angle_ratio, "anything but 0");
  require(c.limit_mLA > 0.0, "torque_limit_mLA", c.limit_mLA, "more than 0 N m");
  require(c.limit_mLS > 0.0, "torque_limit_mLS", c.limit_mLS, "more than 0 N m");
  require(c.first_stance == 0.0 || c.first_stance == 1.0, "first_stance", c.first_stance,
          "0 (left) or 1 (right)");
  samples_ = static_cast<std::size_t>(c.rate_samples);
  place_curves(constants_.gait);
  constants_.absorb_torso.begin = c.gait.theta_begin;
  constants_.absorb_torso.end = c.gait.theta_end;
  reset();
}

void Walking::reset() noexcept {
  state_ = State{};
  state_.right_stance = constants_.first_stance != 0.0;
  known_ = head_ = 0;
  rates_ = Signals{};
}

// Mean rate over the last samples.
void Walking::differentiate(const Signals& now) noexcept {
  const std::size_t back = std::min(known_, samples_);
  if (back > 0) {
    const Signals& then = past_[(head_ + kLongest - back) % kLongest];
    for (std::size_t i = 0; i < kSignals; ++i)
      rates_[i] = (now[i] - then[i]) / (static_cast<double>(back) * period_);
  }
  past_[head_] = now;
  head_ = (head_ + 1) % kLongest;
  known_ = std::min(known_ + 1, kLongest - 1);
}

void Walking::exchange(const WalkReading& reading) noexcept {
  const WalkingGait& gait = constants_.gait;
  const WalkLegReading& stance = state_.right_stance ? reading.right : reading.left;
  const WalkLegReading& swing = state_.right_stance ? reading.left : reading.right;
  const double way = (state_.theta - gait.theta_begin) / (gait.theta_end - gait.theta_begin);
  if (!swing.contact || way < constants_.touchdown_from) return;
  state_.height = below_hip(swing, reading.torso) - below_hip(stance, reading.torso);
  // One step of absorbing, then back.
  state_.absorbing = !state_.absorbing && constants_.absorb != 0.0 && state_.height > constants_.absorb_from;
  state_.right_stance = !state_.right_stance;
  state_.phase = WalkPhase::motor_compress;
  state_.steps += 1.0;
  const WalkLegReading& now = state_.right_stance ? reading.right : reading.left;
  state_.theta = -(leg_angle(now) + reading.torso);
}

void Walking::guard(const WalkReading& reading) noexcept {
  if (state_.fault != WalkFault::none) return;
  for (const WalkLegReading* leg : {&reading.left, &reading.right}) {
    const double angle = leg_angle(*leg);
    const double shape = -0.5 * leg->knee;
    if (angle < constants_.angle_from || angle > constants_.angle_to) state_.fault = WalkFault::leg_angle;
    if (shape < constants_.shape_from || shape > constants_.shape_to) state_.fault = WalkFault::leg_shape;
  }
  const WalkingGait& gait = constants_.gait;
  if (state_.theta < gait.theta_begin - (gait.theta_end - gait.theta_begin))
    state_.fault = WalkFault::backwards;
}

WalkTorques Walking::step(const WalkReading& reading) noexcept {
  const Signals q{leg_angle(reading.left), reading.left.mLS,  reading.left.bsp, leg_angle(reading.right),
                  reading.right.mLS,       reading.right.bsp, reading.torso};
  // The leg angle's rate at the motor: finer counts, and on the motor's side of the cable.
  Signals at_motor = q;
  at_motor[kLA] = reading.left.mLA / constants_.angle_ratio;
  at_motor[kLA + 3] = reading.right.mLA / constants_.angle_ratio;
  differentiate(at_motor);
  state_.theta = -(q[of(state_.right_stance, kLA)] + reading.torso);
  exchange(reading);
  guard(reading);
  const bool right = state_.right_stance;
  state_.phase = next_phase(constants_.gait, state_.phase, state_.theta, q[of(right, kBsp)],
                            rates_[of(right, kBsp)], constants_.latest_sc);
  if (state_.fault != WalkFault::none) return {};
  return torques(q);
}

WalkTorques Walking::torques(const Signals& q) noexcept {
  const WalkConstants& c = constants_;
  const bool stance = state_.right_stance;
  const bool swing = !stance;
  const double theta_rate = -(rates_[of(stance, kLA)] + rates_[kTorsoAngle]);
  std::array<CurvePoint, 4> h = wanted(c.gait, state_.phase, state_.theta);
  std::array<double, 4> star = feedforward(c.gait, state_.phase, state_.theta);
  if (state_.absorbing) {
    h[kTorso] = evaluate(c.absorb_torso, state_.theta, false);
    star[kStanceAngleMotor] = 0.0;
  }
  const std::array<double, 4> at{q[of(stance, kMLS)], q[of(swing, kLA)], q[of(swing, kMLS)], q[kTorsoAngle]};
  const std::array<double, 4> rate{rates_[of(stance, kMLS)], rates_[of(swing, kLA)], rates_[of(swing, kMLS)],
                                   rates_[kTorsoAngle]};
  std::array<double, 4> back{};
  for (std::size_t i = 0; i < 4; ++i) {
    state_.y[i] = at[i] - h[i].value;
    back[i] = c.kp[i] * state_.y[i] + c.kd[i] * (rate[i] - h[i].slope * theta_rate);
  }
  const double angle_sign = c.angle_ratio < 0.0 ? -1.0 : 1.0;
  double stance_shape = star[kStanceShapeMotor] - back[kStanceShape];
  if (state_.absorbing)
    stance_shape = -c.absorb_kp * (at[kStanceShape] - c.absorb_rest) - c.absorb_kd * rate[kStanceShape];
  // What turns the stance leg forward turns the torso back: hence the torso's other sign.
  const double mLA_stance = star[kStanceAngleMotor] + angle_sign * back[kTorso];
  const double mLA_swing = star[kSwingAngleMotor] - angle_sign * back[kSwingAngle];
  const double mLS_swing = star[kSwingShapeMotor] - back[kSwingShape];
  const auto within = [](double u, double limit) { return std::clamp(u, -limit, limit); };
  WalkTorques u{};
  u[stance ? 2 : 0] = within(mLA_stance, c.limit_mLA);
  u[stance ? 3 : 1] = within(stance_shape, c.limit_mLS);
  u[stance ? 0 : 2] = within(mLA_swing, c.limit_mLA);
  u[stance ? 1 : 3] = within(mLS_swing, c.limit_mLS);
  return u;
}

}  // namespace plumbline::controllers
