#include "controllers/monopod/sampled.h"

#include <algorithm>
#include <cmath>

namespace plumbline::monopod {
namespace {

constexpr int kSettle = 4;          // samples until the first rates are worth something
constexpr double kMostLean = 1.0;   // rad: no stride leans by more than 0.2
constexpr double kMostBend = 1.3;   // rad of leg shape: no stride bends by more than 0.5
constexpr double kRestBend = 0.02;  // rad of B_Spring: less is within two counts of its stop

}  // namespace

SampledRunning::SampledRunning(const Parameters& parameters, double period)
    : p_(parameters), period_(period), running_(parameters.model, parameters.gait) {}

void SampledRunning::reset() {
  running_ = Running(p_.model, p_.gait);
  state_ = State();
  acceleration_.setZero();
  samples_ = open_ = 0;
  flown_ = false;
  fault_ = kNone;
}

void SampledRunning::filter(const Sample& sample) {
  Vector6 measured;
  measured << sample.thigh + 0.5 * sample.knee, -0.5 * sample.knee, sample.motor, sample.torso, sample.hip_x,
      sample.hip_z;
  if (samples_ == 0) {
    state_.q = measured;
    return;
  }
  const Vector6 foretold = state_.q + period_ * state_.v + 0.5 * period_ * period_ * acceleration_;
  const Vector6 off = measured - foretold;
  const bool begins = samples_ < kSettle;  // nothing is known yet: difference quotients
  state_.q = foretold + (begins ? 1.0 : p_.position_share) * off;
  state_.v += period_ * acceleration_ + (begins ? 1.0 : p_.rate_share) / period_ * off;
}

void SampledRunning::follow_events(const Sample& sample) {
  const Constants& c = p_.model;
  open_ = sample.contact ? 0 : open_ + 1;
  switch (running_.phase()) {
    case Phase::flight:
      if (!flown_) {
        // The polynomials of the first flight begin wherever the robot is let go.
        const Dynamics d = dynamics(c, state_);
        running_.lift_off(state_, d.com[1] - d.toe[1]);
        flown_ = true;
      }
      if (sample.contact) {
        const State before = state_;
        const Dynamics d = dynamics(c, before);
        state_.v = impact(d, stance(d), before.v);
        running_.touch_down(before, state_);
      }
      return;
    case Phase::compression:
      if (deflection(c, state_.v) < 0.0 && deflection(c, state_.q) > kRestBend) {
        running_.inject(state_);
      }
      return;
    case Phase::injection:
      if (running_.injected(state_)) {
        running_.decompress();
      }
      [[fallthrough]];
    case Phase::decompression:
      if (open_ > 0) {
        const Dynamics d = dynamics(c, state_);
        state_.v = impact(d, flight(c, d), state_.v);
        running_.lift_off(state_, d.com[1] - d.toe[1]);
      }
      return;
  }
}

Vector2 SampledRunning::step(const Sample& sample) {
  if (fault_ != kNone) {
    return Vector2::Zero();
  }
  filter(sample);
  if (std::abs(sample.torso) > kMostLean) {
    fault_ = kTorsoFell;
  } else if (std::abs(0.5 * sample.knee) > kMostBend) {
    fault_ = kLegFolded;
  }
  if (++samples_ <= kSettle || fault_ != kNone) {
    acceleration_.setZero();
    return Vector2::Zero();
  }
  follow_events(sample);
  const Dynamics d = dynamics(p_.model, state_);
  Vector2 torque = running_.torque(state_, d);
  torque[0] = std::clamp(torque[0], -p_.angle_torque, p_.angle_torque);
  torque[1] = std::clamp(torque[1], -p_.shape_torque, p_.shape_torque);
  const Acceleration a =
      running_.phase() == Phase::flight ? accelerations(d, flight(p_.model, d)) : accelerations(d, stance(d));
  acceleration_ = a.drift + a.gain * torque;
  return torque;
}

}  // namespace plumbline::monopod
