#include "tests/battery/cases.h"

namespace plumbline::battery {

// Nominal values: weak, medium and strong leave the model as it is with a held-out error of about 3, 10 and
// 40 floors where its own numbers are as stated (`battery --rig mabel --as-stated --bare`). Of what the model
// states of its own numbers (masses, rotor inertias, torque constants, springs) only a mass is hidden here.
const std::vector<Row>& mabel_rows() {
  static const std::vector<Row> kRows{
      {"coulomb", "mLA_left", "level=0.006|0.02|0.07,smoothing_speed=0.03"},
      {"coulomb", "mLS_right", "level=0.01|0.03|0.12,smoothing_speed=0.03"},
      {"load_friction", "mLS_left", "coefficient=0.002|0.006|0.02,smoothing_speed=0.03"},
      {"cogging", "mLA_right", "sine=0.02|0.07|0.2,cosine=0.015|0.04|0.13,cycles=12"},
      {"torque_bias", "mLA_left", "bias=0.006|0.02|0.07"},
      {"torque_bias", "mLS_right", "bias=0.005|0.015|0.05"},
      {"actuator_lag", "mLS_left", "time_constant=1e-4|3e-4|1e-3"},
      {"command_delay", "mLA_right", "delay=1e-4|3e-4|1e-3"},
      {"quadratic", "mLS_left", "drag=4e-6|1.2e-5|5e-5"},
      {"coulomb", "thigh_left", "level=0.15|0.5|1.7,smoothing_speed=0.003"},
      {"viscous", "shin_right", "damping=0.05|0.15|0.5"},
      {"preload", "leg_angle_left", "preload=0.2|0.6|2"},
      {"spring", "leg_shape_right", "stiffness=0.2|0.6|2,rest=0.3"},
      {"hysteresis", "bsp_left", "loss=0.3|1|4,rest=0,smoothing_speed=0.003"},
      {"hardening", "bsp_right", "cubic_stiffness=4|12|50,rest=0"},
      {"hard_stop", "leg_shape_left",
       "cubic_stiffness=150|500|2000,damping=0.3|1|4,root_damping=0.1|0.3|1,position=0.35,side=1,pulls=0"},
      {"com_shift", "torso_link", "x=5e-4|1.5e-3|5e-3,z=-5e-4|-1.5e-3|-5e-3"},
      {"added_mass", "shin_left", "mass=0.1|0.2|0.4"},
      {"encoder_offset", "knee_left", "offset=4e-3|0.012|0.035"},
      {"encoder_scale", "mLS_right", "scale=1+2e-4|7e-4|2e-3"},
      {"coulomb", "hip_x", "level=0.3|1|3,smoothing_speed=0.01"},
      {"gravity_tilt", "world", "pitch=5e-4|1.5e-3|5e-3"},
      {"boom", "base", "curvature=0.015|0.03|0.1,level=1"},
      {"ground_stiffness_error", "left", "scale=1+0.1|0.3|1"},
      {"ground_friction_error", "right", "scale=1-0.05|0.15|0.4"},
      {"ground_height_error", "left", "height=3e-4|1e-3|3e-3"},
  };
  return kRows;
}

}  // namespace plumbline::battery
