// Every number of the running controller under one name and unit: ports of the library, keys of files.
#pragma once

#include <array>

#include "controllers/monopod/running.h"

namespace plumbline::monopod {

struct Parameters {
  Constants model;
  Gait gait;
  /// Shares of the difference between measured and foretold position that positions and rates are corrected
  /// by at each sample; 1 and 1 are difference quotients.
  double position_share = 1.0, rate_share = 1.0;
  double angle_torque = 0.0, shape_torque = 0.0;  ///< limits of the commands, N m
};

struct ParameterName {
  const char* name;
  const char* unit;
};

constexpr std::array<ParameterName, 89> kParameters{{
    {"torso_mass", "kg"},
    {"torso_x", "m"},
    {"torso_z", "m"},
    {"torso_inertia", "kg m^2"},
    {"thigh_mass", "kg"},
    {"thigh_x", "m"},
    {"thigh_z", "m"},
    {"thigh_inertia", "kg m^2"},
    {"shin_mass", "kg"},
    {"shin_x", "m"},
    {"shin_z", "m"},
    {"shin_inertia", "kg m^2"},
    {"thigh_length", "m"},
    {"shin_length", "m"},
    {"leg_angle_ratio", "1"},
    {"leg_shape_ratio", "1"},
    {"spring_ratio", "1"},
    {"leg_angle_inertia", "kg m^2"},
    {"leg_shape_inertia", "kg m^2"},
    {"spring_inertia", "kg m^2"},
    {"spring_stiffness", "N m/rad"},
    {"spring_preload", "N m"},
    {"spring_damping", "N m s/rad"},
    {"leg_angle_friction", "N m s/rad"},
    {"leg_shape_friction", "N m s/rad"},
    {"gravity", "m/s^2"},
    {"toe_0", "m"},
    {"toe_1", "m"},
    {"toe_2", "m"},
    {"toe_3", "m"},
    {"toe_4", "m"},
    {"toe_5", "m"},
    {"toe_6", "m"},
    {"shape_0", "rad"},
    {"shape_1", "rad"},
    {"shape_2", "rad"},
    {"shape_3", "rad"},
    {"shape_4", "rad"},
    {"shape_5", "rad"},
    {"shape_6", "rad"},
    {"torso_start", "rad"},
    {"torso_2", "rad"},
    {"torso_3", "rad"},
    {"motor_middle", "1"},
    {"theta_max", "rad"},
    {"injection_span", "rad"},
    {"touchdown_height", "m"},
    {"beta_torso", "rad"},
    {"beta_motor", "rad"},
    {"beta_toe", "m"},
    {"at_leg_angle", "rad"},
    {"at_leg_shape", "rad"},
    {"at_torso", "rad"},
    {"at_leg_angle_rate", "rad/s"},
    {"at_leg_shape_rate", "rad/s"},
    {"at_torso_rate", "rad/s"},
    {"at_speed", "m/s"},
    {"at_fall", "m/s"},
    {"torso_by_leg_angle", "1"},
    {"torso_by_leg_shape", "1"},
    {"torso_by_torso", "1"},
    {"torso_by_leg_angle_rate", "s"},
    {"torso_by_leg_shape_rate", "s"},
    {"torso_by_torso_rate", "s"},
    {"torso_by_speed", "rad s/m"},
    {"torso_by_fall", "rad s/m"},
    {"motor_by_leg_angle", "1"},
    {"motor_by_leg_shape", "1"},
    {"motor_by_torso", "1"},
    {"motor_by_leg_angle_rate", "s"},
    {"motor_by_leg_shape_rate", "s"},
    {"motor_by_torso_rate", "s"},
    {"motor_by_speed", "rad s/m"},
    {"motor_by_fall", "rad s/m"},
    {"toe_by_leg_angle", "m/rad"},
    {"toe_by_leg_shape", "m/rad"},
    {"toe_by_torso", "m/rad"},
    {"toe_by_leg_angle_rate", "m s/rad"},
    {"toe_by_leg_shape_rate", "m s/rad"},
    {"toe_by_torso_rate", "m s/rad"},
    {"toe_by_speed", "s"},
    {"toe_by_fall", "s"},
    {"kp", "1/s^2"},
    {"kv", "1/s"},
    {"epsilon", "1"},
    {"position_share", "1"},
    {"rate_share", "1"},
    {"leg_angle_torque", "N m"},
    {"leg_shape_torque", "N m"},
}};

constexpr std::size_t kParameterCount = kParameters.size();
constexpr std::size_t kConstantCount = 26;  ///< the first ones: the robot's own

/// Where each of them sits, in the order of kParameters.
std::array<double*, kParameterCount> slots(Parameters& p);
/// The robot's own alone, in the same order.
std::array<double*, kConstantCount> slots(Constants& c);

}  // namespace plumbline::monopod
