#include "controllers/monopod/sampled.h"

#include <algorithm>
#include <cmath>

namespace plumbline::monopod {
namespace {

constexpr int kSettle = 4;   // samples until the first rates are worth something
constexpr int kBounced = 5;  // samples with an open switch that are no lift-off while the motor injects
constexpr double kShortestFlight =
    0.03;                           // s: a switch that closes before has not been open; a flight lasts 0.12 s
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
  samples_ = open_ = flown_for_ = 0;
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
  // Begins as the straight line of least squares through all samples so far, whose shares shrink with their
  // number, until those shares reach the filter's own.
  const double n = samples_ + 1.0;
  const double position = std::max(p_.position_share, 2.0 * (2.0 * n - 1.0) / (n * (n + 1.0)));
  const double rate = std::max(p_.rate_share, 6.0 / (n * (n + 1.0)));
  state_.q = foretold + position * off;
  state_.v += period_ * acceleration_ + rate / period_ * off;
}

void SampledRunning::follow_events(const Sample& sample) {
  const Constants& c = p_.model;
  open_ = sample.contact ? 0 : open_ + 1;
  switch (running_.phase()) {
    case Phase::flight:
      if (!flown_) {
        const Dynamics d = dynamics(c, state_);
        running_.drop(state_, d.com[1] - d.toe[1]);
        flown_ = true;
        flown_for_ = static_cast<int>(kShortestFlight / period_);  // it was in the air before
      }
      if (++flown_for_ * period_ > kShortestFlight && sample.contact) {
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
      // Lift-off is where the spring comes to its stop or the ground no longer carries; a foot that has
      // bounced comes back while the motor still injects.
      if (open_ > (running_.phase() == Phase::injection ? kBounced : 0) ||
          (running_.phase() == Phase::decompression && deflection(c, state_.q) < 0.0)) {
        const Dynamics d = dynamics(c, state_);
        state_.v = impact(d, flight(c, d), state_.v);
        running_.lift_off(state_, d.com[1] - d.toe[1]);
        flown_for_ = 0;
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
