#include "controllers/mabel_hopping/hopping_config.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline::controllers {
namespace {

void require(bool holds, const char* name, const char* expected) {
  if (!holds) throw std::invalid_argument(std::string("hopping: ") + name + " must be " + expected);
}

void finite(double value, const char* name) { require(std::isfinite(value), name, "finite"); }

void positive(double value, const char* name) {
  require(std::isfinite(value) && value > 0.0, name, "finite and positive");
}

void not_negative(double value, const char* name) {
  require(std::isfinite(value) && value >= 0.0, name, "finite and not negative");
}

void not_zero(double value, const char* name) {
  require(std::isfinite(value) && value != 0.0, name, "finite and not 0");
}

// Also keeps the count of samples well inside an integer.
void duration(double value, double period, const char* name) {
  require(value >= 0.0 && value / period < 1e9, name, "finite, not negative and less than 1e9 periods");
}

void validate_parameters(const HoppingParameters& p) {
  finite(p.delta_LA, "delta_LA");
  finite(p.h_T0, "h_T0");
  finite(p.h_LS_left, "h_LS_left");
  finite(p.h_LS_right, "h_LS_right");
  finite(p.delta_LS_minus_left, "delta_LS_minus_left");
  finite(p.delta_LS_minus_right, "delta_LS_minus_right");
  finite(p.delta_LS_plus_left, "delta_LS_plus_left");
  finite(p.delta_LS_plus_right, "delta_LS_plus_right");
  not_zero(p.gamma_LA_to_mLA, "gamma_LA_to_mLA");
  not_zero(p.gamma_LS_to_mLS, "gamma_LS_to_mLS");
  not_negative(p.hip_velocity_band, "hip_velocity_band");
  finite(p.K_T, "K_T");
  finite(p.delta_phi_d, "delta_phi_d");
  not_negative(p.delta_h_T_limit, "delta_h_T_limit");
  if (p.event_update) positive(p.delta_h_T_limit, "delta_h_T_limit");
}

void validate_gains(const HoppingLegGains& gains) {
  not_negative(gains.kp_LA, "kp_LA");
  not_negative(gains.kd_LA, "kd_LA");
  not_negative(gains.kp_mLS, "kp_mLS");
  not_negative(gains.kd_mLS, "kd_mLS");
}

void validate_resolutions(const HoppingResolutions& resolution) {
  not_zero(resolution.mLA, "the resolution of mLA");
  not_zero(resolution.mLS, "the resolution of mLS");
  not_zero(resolution.thigh, "the resolution of the thigh");
  not_zero(resolution.knee, "the resolution of the knee");
  not_zero(resolution.torso, "the resolution of the torso");
  not_zero(resolution.tower, "the resolution of the tower");
  not_zero(resolution.boom_pitch, "the resolution of the boom's pitch");
}

void validate_times(const HoppingConfig& config) {
  const HoppingSupplements& ours = config.supplements;
  duration(config.parameters.retract_time, config.period, "retract_time");
  require(config.parameters.retract_time >= 0.5 * config.period, "retract_time", "at least half a period");
  require(ours.contact_samples >= 1, "contact_samples", "1 or more");
  duration(ours.touchdown_time_min, config.period, "touchdown_time_min");
  duration(ours.bounce_time, config.period, "bounce_time");
  duration(ours.kickoff_time_max, config.period, "kickoff_time_max");
  duration(ours.liftoff_time_max, config.period, "liftoff_time_max");
}

void validate_workspace(const HoppingWorkspace& workspace) {
  require(workspace.leg_angle_from < workspace.leg_angle_to, "leg_angle_from", "below leg_angle_to");
  require(workspace.leg_shape_from < workspace.leg_shape_to, "leg_shape_from", "below leg_shape_to");
}

}  // namespace

void validate(const HoppingConfig& config) {
  positive(config.period, "the period");
  positive(config.boom_length, "boom_length");
  validate_parameters(config.parameters);
  validate_gains(config.left);
  validate_gains(config.right);
  positive(config.torque_limit_mLA, "torque_limit_mLA");
  positive(config.torque_limit_mLS, "torque_limit_mLS");
  validate_resolutions(config.resolution);
  validate_times(config);
  validate_workspace(config.workspace);
}

}  // namespace plumbline::controllers
