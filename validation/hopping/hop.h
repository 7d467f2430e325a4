// One hop as it is reported.
#pragma once

namespace plumbline::validation {

/// From one landing to the next.
struct Hop {
  double landing = 0.0;        ///< time at which both feet are down, s
  double period = 0.0;         ///< s
  double travel = 0.0;         ///< of the hip along its circle, forward positive, m
  double torso = 0.0;          ///< at the landing, rad
  double torso_wanted = 0.0;   ///< h_T^d from the landing on, rad
  double touchdown_gap = 0.0;  ///< between the two feet's contact at this landing, s
  double largest_torque_mLA = 0.0, largest_torque_mLS = 0.0;  ///< N m
  double time_at_limit = 0.0;  ///< summed over the motors, that a command is at its limit, s
  double largest_stretch_LA = 0.0, largest_stretch_LS = 0.0;  ///< |c(q)| of equation 23, rad of motor
  double lowest_hip = 0.0, highest_hip = 0.0;                 ///< above a level boom, m
};

}  // namespace plumbline::validation
