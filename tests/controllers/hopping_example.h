// A complete configuration for the tests of hopping. The paper's values where it gives them (sidebar 2,
// sections Sensors and Transmission); gains and limits are round numbers to calculate with, not a robot's.
#pragma once

#include "controllers/mabel_hopping/hopping_config.h"

namespace plumbline::controllers {

inline constexpr double turn = 6.283185307179586;  // rad

inline HoppingParameters paper_parameters() {
  HoppingParameters p;
  p.delta_LA = 0.524;
  p.h_T0 = 0.140;
  p.h_LS_left = 0.209;
  p.h_LS_right = 0.209;
  p.delta_LS_minus_left = 0.087;
  p.delta_LS_minus_right = 0.227;
  p.delta_LS_plus_left = 0.087;
  p.delta_LS_plus_right = 0.087;
  p.gamma_LA_to_mLA = -23.53;
  p.gamma_LS_to_mLS = 31.42;
  p.hip_velocity_band = 0.0225;
  p.retract_time = 0.05;
  p.event_update = true;
  p.K_T = 0.5;
  p.delta_phi_d = -0.120;
  p.delta_h_T_limit = 0.05;
  return p;
}

inline HoppingConfig hopping_example() {
  HoppingConfig c;
  c.period = 1e-3;
  c.boom_length = 2.25;
  c.parameters = paper_parameters();
  c.left = {400.0, 10.0, 2.0, 0.05};
  c.right = {500.0, 20.0, 3.0, 0.10};
  c.torque_limit_mLA = 10.0;
  c.torque_limit_mLS = 20.0;
  c.resolution = {turn / 2048, turn / 2048,   turn / 40550.4, turn / 2048,
                  turn / 6144, turn / 295948, turn / 36044.8};
  return c;
}

}  // namespace plumbline::controllers
