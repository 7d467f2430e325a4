#include "controllers/mabel_hopping/hopping.h"

#include <algorithm>
#include <cmath>

namespace plumbline::controllers {
namespace {

const HoppingConfig& validated(const HoppingConfig& config) {
  validate(config);
  return config;
}

double angle(std::int64_t counts, double resolution) noexcept {
  return static_cast<double>(counts) * resolution;
}

double within(double value, double limit) noexcept { return std::clamp(value, -limit, limit); }

// The leg shape that one leg is asked for. `up`: this foot has left the ground since the kickoff.
double leg_shape(HoppingPhase phase, bool up, double h_LS, double minus, double plus) noexcept {
  if (phase == HoppingPhase::flight || phase == HoppingPhase::touchdown) return h_LS;
  return up ? h_LS + plus : h_LS - minus;
}

}  // namespace

const char* to_string(StopSwitch stop) noexcept {
  switch (stop) {
    case StopSwitch::none:
      return "none";
    case StopSwitch::leg_angle_left:
      return "leg angle, left";
    case StopSwitch::leg_shape_left:
      return "leg shape, left";
    case StopSwitch::leg_angle_right:
      return "leg angle, right";
    case StopSwitch::leg_shape_right:
      return "leg shape, right";
  }
  return "";
}

Hopping::Hopping(const HoppingConfig& config)
    : config_(validated(config)),
      phases_(config),
      filters_{RateFilter(config.leg_angle_filter, config.period),
               RateFilter(config.leg_shape_filter, config.period),
               RateFilter(config.leg_angle_filter, config.period),
               RateFilter(config.leg_shape_filter, config.period)},
      hip_filter_(config.hip_filter, config.period),
      h_T_d_(config.parameters.h_T0) {}

void Hopping::reset() noexcept {
  phases_ = HoppingPhases(config_);
  for (RateFilter& filter : filters_) filter.reset();
  hip_filter_.reset();
  h_ = rates_ = reference_ = HoppingVector{};
  hip_velocity_ = 0.0;
  h_T_d_ = config_.parameters.h_T0;
  tower_at_landing_ = 0;
  landed_ = false;
  power_off_ = StopSwitch::none;
}

void Hopping::resume(double h_T_d, std::int64_t tower) noexcept {
  reset();
  remember(h_T_d, tower, true);
}

void Hopping::remember(double h_T_d, std::int64_t tower, bool landed) noexcept {
  h_T_d_ = h_T_d;
  tower_at_landing_ = tower;
  landed_ = landed;
}

double Hopping::time_in_phase() const noexcept {
  return static_cast<double>(phases_.samples_in_phase()) * config_.period;
}

long Hopping::hops() const noexcept { return std::max(phases_.landings() - 1, 0L); }

HoppingTorques Hopping::command(const HoppingSample& sample) noexcept {
  measure(sample);
  if (power_off_ == StopSwitch::none) power_off_ = stop_switch(sample);
  const HoppingPhase before = phases_.phase();
  const long landings = phases_.landings();
  phases_.update(sample.left_contact, sample.right_contact, hip_velocity_);
  if (phases_.landings() != landings) land(sample.tower);
  refer_leg_angles(before, angle(sample.torso, config_.resolution.torso));
  refer_leg_shapes();
  return power_off_ == StopSwitch::none ? torques() : HoppingTorques();
}

// Equation 1 relative to the torso: q_LA = (q_Th + q_Sh)/2 with q_Sh = q_Th + knee.
double Hopping::leg_angle(const LegCounts& counts, LegAngleSource source) const noexcept {
  const HoppingResolutions& resolution = config_.resolution;
  if (source == LegAngleSource::motor) {
    return angle(counts.mLA, resolution.mLA) / config_.parameters.gamma_LA_to_mLA;
  }
  return angle(counts.thigh, resolution.thigh) + 0.5 * angle(counts.knee, resolution.knee);
}

void Hopping::measure(const HoppingSample& sample) noexcept {
  h_.LA_left = leg_angle(sample.left, config_.leg_angle);
  h_.mLS_left = angle(sample.left.mLS, config_.resolution.mLS);
  h_.LA_right = leg_angle(sample.right, config_.leg_angle);
  h_.mLS_right = angle(sample.right.mLS, config_.resolution.mLS);
  rates_.LA_left = filters_[0].rate(leg_angle(sample.left, config_.leg_angle_rate));
  rates_.mLS_left = filters_[1].rate(h_.mLS_left);
  rates_.LA_right = filters_[2].rate(leg_angle(sample.right, config_.leg_angle_rate));
  rates_.mLS_right = filters_[3].rate(h_.mLS_right);
  const double pitch = angle(sample.boom_pitch, config_.resolution.boom_pitch);
  hip_velocity_ = hip_filter_.rate(config_.boom_length * std::sin(pitch));
}

StopSwitch Hopping::stop_switch(const HoppingSample& sample) const noexcept {
  const HoppingWorkspace& space = config_.workspace;
  const auto outside = [](double value, double from, double to) { return value < from || value > to; };
  const auto angle_outside = [&](const LegCounts& leg) {
    return outside(leg_angle(leg, LegAngleSource::joints), space.leg_angle_from, space.leg_angle_to);
  };
  const auto shape_outside = [&](const LegCounts& leg) {
    return outside(-0.5 * angle(leg.knee, config_.resolution.knee), space.leg_shape_from, space.leg_shape_to);
  };
  if (angle_outside(sample.left)) return StopSwitch::leg_angle_left;
  if (shape_outside(sample.left)) return StopSwitch::leg_shape_left;
  if (angle_outside(sample.right)) return StopSwitch::leg_angle_right;
  if (shape_outside(sample.right)) return StopSwitch::leg_shape_right;
  return StopSwitch::none;
}

void Hopping::land(std::int64_t tower_counts) noexcept {
  const HoppingParameters& p = config_.parameters;
  const double travelled = angle(tower_counts - tower_at_landing_, config_.resolution.tower);
  tower_at_landing_ = tower_counts;
  const bool first = !landed_;
  landed_ = true;
  if (first || !p.event_update) return;
  h_T_d_ = p.h_T0 + within(p.K_T * (travelled - p.delta_phi_d), p.delta_h_T_limit);
}

// At the sample that ends III the equations of III are used once more: that is h_III^ref(t_III*), which IV
// and V hold.
void Hopping::refer_leg_angles(HoppingPhase before, double q_T) noexcept {
  const HoppingPhase now = phases_.phase();
  const double delta_LA = config_.parameters.delta_LA;
  if (now == HoppingPhase::flight) {
    reference_.LA_left = -0.5 * delta_LA - h_T_d_;
    reference_.LA_right = 0.5 * delta_LA - h_T_d_;
  } else if (now == HoppingPhase::touchdown || now == HoppingPhase::kickoff ||
             before == HoppingPhase::kickoff) {
    reference_.LA_right = q_T + h_.LA_right - h_T_d_;
    reference_.LA_left = reference_.LA_right - delta_LA;
  }
}

void Hopping::refer_leg_shapes() noexcept {
  const HoppingParameters& p = config_.parameters;
  const HoppingPhase now = phases_.phase();
  const bool both_up = now == HoppingPhase::retract;
  reference_.mLS_left =
      p.gamma_LS_to_mLS * leg_shape(now, both_up || now == HoppingPhase::left_liftoff, p.h_LS_left,
                                    p.delta_LS_minus_left, p.delta_LS_plus_left);
  reference_.mLS_right =
      p.gamma_LS_to_mLS * leg_shape(now, both_up || now == HoppingPhase::right_liftoff, p.h_LS_right,
                                    p.delta_LS_minus_right, p.delta_LS_plus_right);
}

HoppingTorques Hopping::torques() const noexcept {
  const HoppingLegGains& l = config_.left;
  const HoppingLegGains& r = config_.right;
  const double gamma = config_.parameters.gamma_LA_to_mLA;
  const double mLA = config_.torque_limit_mLA;
  const double mLS = config_.torque_limit_mLS;
  const auto pd = [](double kp, double kd, double reference, double h, double rate) {
    return kp * (reference - h) - kd * rate;
  };
  return {within(pd(l.kp_LA, l.kd_LA, reference_.LA_left, h_.LA_left, rates_.LA_left) / gamma, mLA),
          within(pd(l.kp_mLS, l.kd_mLS, reference_.mLS_left, h_.mLS_left, rates_.mLS_left), mLS),
          within(pd(r.kp_LA, r.kd_LA, reference_.LA_right, h_.LA_right, rates_.LA_right) / gamma, mLA),
          within(pd(r.kp_mLS, r.kd_mLS, reference_.mLS_right, h_.mLS_right, rates_.mLS_right), mLS)};
}

}  // namespace plumbline::controllers
