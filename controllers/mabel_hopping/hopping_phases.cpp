#include "controllers/mabel_hopping/hopping_phases.h"

#include <cmath>

namespace plumbline::controllers {

const char* to_string(HoppingPhase phase) noexcept {
  switch (phase) {
    case HoppingPhase::flight:
      return "I";
    case HoppingPhase::touchdown:
      return "II";
    case HoppingPhase::kickoff:
      return "III";
    case HoppingPhase::left_liftoff:
      return "IVa";
    case HoppingPhase::right_liftoff:
      return "IVb";
    case HoppingPhase::retract:
      return "V";
  }
  return "";
}

HoppingPhases::HoppingPhases(const HoppingConfig& config) noexcept
    : band_(config.parameters.hip_velocity_band),
      touchdown_min_(std::lround(config.supplements.touchdown_time_min / config.period)),
      bounce_(std::lround(config.supplements.bounce_time / config.period)),
      kickoff_max_(std::lround(config.supplements.kickoff_time_max / config.period)),
      liftoff_max_(std::lround(config.supplements.liftoff_time_max / config.period)),
      retract_(std::lround(config.parameters.retract_time / config.period)),
      left_(config.supplements.contact_samples),
      right_(config.supplements.contact_samples) {}

HoppingPhase HoppingPhases::update(bool left_contact, bool right_contact, double hip_velocity) noexcept {
  const bool left = left_.update(left_contact);
  const bool right = right_.update(right_contact);
  ++samples_in_phase_;
  samples_bounced_ = left && right ? 0 : samples_bounced_ + 1;
  const HoppingPhase following = next(left, right, hip_velocity);
  if (following != phase_) enter(following);
  return phase_;
}

HoppingPhase HoppingPhases::next(bool left, bool right, double hip_velocity) const noexcept {
  switch (phase_) {
    case HoppingPhase::flight:
      return after_flight(left, right);
    case HoppingPhase::touchdown:
      return after_touchdown(left, right, hip_velocity);
    case HoppingPhase::kickoff:
      return after_kickoff(left, right);
    case HoppingPhase::left_liftoff:
      return after_liftoff(right);
    case HoppingPhase::right_liftoff:
      return after_liftoff(left);
    case HoppingPhase::retract:
      return after_retract();
  }
  return phase_;
}

HoppingPhase HoppingPhases::after_flight(bool left, bool right) const noexcept {
  return left && right ? HoppingPhase::touchdown : HoppingPhase::flight;
}

HoppingPhase HoppingPhases::after_touchdown(bool left, bool right, double hip_velocity) const noexcept {
  if (samples_bounced_ > bounce_) return HoppingPhase::flight;
  const bool rising = hip_velocity > -band_;
  const bool settled = samples_in_phase_ >= touchdown_min_;
  return rising && settled && (left || right) ? HoppingPhase::kickoff : HoppingPhase::touchdown;
}

HoppingPhase HoppingPhases::after_kickoff(bool left, bool right) const noexcept {
  if (!left && !right) return HoppingPhase::retract;
  if (!left) return HoppingPhase::left_liftoff;
  if (!right) return HoppingPhase::right_liftoff;
  const bool overdue = kickoff_max_ > 0 && samples_in_phase_ >= kickoff_max_;
  return overdue ? HoppingPhase::touchdown : HoppingPhase::kickoff;
}

HoppingPhase HoppingPhases::after_liftoff(bool other) const noexcept {
  if (!other) return HoppingPhase::retract;
  const bool overdue = liftoff_max_ > 0 && samples_in_phase_ >= liftoff_max_;
  return overdue ? HoppingPhase::flight : phase_;
}

HoppingPhase HoppingPhases::after_retract() const noexcept {
  return samples_in_phase_ >= retract_ ? HoppingPhase::flight : HoppingPhase::retract;
}

void HoppingPhases::enter(HoppingPhase phase) noexcept {
  if (phase == HoppingPhase::retract) flown_ = true;
  if (phase == HoppingPhase::touchdown && phase_ == HoppingPhase::flight && flown_) {
    ++landings_;
    flown_ = false;
  }
  phase_ = phase;
  samples_in_phase_ = 0;
}

}  // namespace plumbline::controllers
