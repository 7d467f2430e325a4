#include "tests/battery/cases.h"

namespace plumbline::battery {

// Nominal values: weak, medium and strong leave the model as it is with a held-out error of about 2.5, 6 and
// 18 floors. Where the model states an uncertainty of the same number (its friction, springs and masses) weak
// is four of these deviations, so that the model's own parameter cannot take it up.
const std::vector<Row>& hopper_rows() {
  static const std::vector<Row> kRows{
      {"viscous", "drive", "damping=8e-4|1.6e-3|3e-3"},
      {"coulomb", "drive", "level=0.00056|0.0015|0.0046,smoothing_speed=0.1"},
      {"stribeck", "drive",
       "level=0.0004|0.0011|0.0033,rise=0.0006|0.0016|0.0049,stribeck_speed=8,smoothing_speed=0.1"},
      {"lugre", "drive",
       "level=0.00045|0.0012|0.0037,rise=0.00022|0.00061|0.0018,stiffness=0.0022|0.0061|0.018,bristle_"
       "damping=1.4e-6|3.8e-6|1.1e-5,viscous=1.4e-6|3.8e-6|1.1e-5,stribeck_speed=8"},
      {"viscous_directional", "drive", "difference=2.1e-5|5.7e-5|0.00017"},
      {"coulomb_directional", "drive", "difference=0.00031|0.00086|0.0026,smoothing_speed=0.1"},
      {"quadratic", "drive", "drag=6.9e-7|1.9e-6|5.6e-6"},
      {"load_friction", "drive", "coefficient=0.00078|0.0021|0.0064,smoothing_speed=0.1"},
      {"gear_friction", "drive", "coefficient=0.00078|0.0021|0.0064,smoothing_speed=0.1"},
      {"cogging", "drive", "sine=0.00068|0.0019|0.0056,cosine=0.00046|0.0012|0.0037,cycles=6"},
      {"torque_bias", "drive", "bias=0.00032|0.00088|0.0026"},
      {"torque_constant_error", "drive", "scale=1+0.00078|0.0021|0.0064"},
      {"actuator_lag", "drive", "time_constant=3.6e-5|9.7e-5|0.00029"},
      {"command_delay", "drive", "delay=2.8e-5|7.6e-5|0.00023"},
      {"rotor_inertia", "drive", "inertia=4e-5|8e-5|1.6e-4"},
      {"viscous", "height", "damping=0.052|0.14|0.43"},
      {"coulomb", "height", "level=0.026|0.07|0.21,smoothing_speed=0.003"},
      {"stribeck", "height",
       "level=0.025|0.068|0.2,rise=0.037|0.1|0.3,stribeck_speed=0.16,smoothing_speed=0.003"},
      {"lugre", "height",
       "level=0.022|0.061|0.18,rise=0.011|0.031|0.092,stiffness=5.6|15|46,bristle_damping=0.0035|0.0095|0."
       "029,viscous=0.0035|0.0095|0.029,stribeck_speed=0.16"},
      {"viscous_directional", "height", "difference=0.031|0.084|0.25"},
      {"coulomb_directional", "height", "difference=0.014|0.038|0.11,smoothing_speed=0.003"},
      {"quadratic", "height", "drag=0.093|0.25|0.76"},
      {"viscous", "spring", "damping=6|12|20"},
      {"coulomb", "spring", "level=0.063|0.17|0.52,smoothing_speed=0.001"},
      {"stribeck", "spring",
       "level=0.058|0.16|0.47,rise=0.087|0.24|0.71,stribeck_speed=0.06,smoothing_speed=0.001"},
      {"lugre", "spring",
       "level=0.053|0.14|0.43,rise=0.027|0.072|0.22,stiffness=35|96|2.9e2,bristle_damping=0.022|0.06|0.18,"
       "viscous=0.022|0.06|0.18,stribeck_speed=0.06"},
      {"viscous_directional", "spring", "difference=0.21|0.56|1.7"},
      {"coulomb_directional", "spring", "difference=0.061|0.17|0.5,smoothing_speed=0.001"},
      {"quadratic", "spring", "drag=0.31|0.84|2.5"},
      {"hysteresis", "height", "loss=1.1|3|9.1,rest=0.4,smoothing_speed=0.001"},
      {"spring", "height", "stiffness=0.45|1.2|3.6,rest=0.4"},
      {"preload", "height", "preload=0.014|0.037|0.11"},
      {"hardening", "height", "cubic_stiffness=2.2e2|5.9e2|1.8e3,rest=0.4"},
      {"unilateral_spring", "height",
       "stiffness=0.5|1.4|4.1,preload=0.0075|0.02|0.061,rest=0.38,side=-1,smoothing_length=0.001"},
      {"hard_stop", "height",
       "cubic_stiffness=1e4|2.8e4|2.4e5,damping=0.084|0.23|2,root_damping=0.013|0.034|0.3,position=0.44,side="
       "1,pulls=0"},
      {"hysteresis", "carriage", "loss=1.6|4.3|13,rest=0,smoothing_speed=0.001"},
      {"spring", "carriage", "stiffness=48|100|200,rest=0.02"},
      {"preload", "carriage", "preload=0.016|0.043|0.13"},
      {"hardening", "carriage", "cubic_stiffness=1.9e3|5.2e3|1.6e4,rest=0"},
      {"unilateral_spring", "carriage",
       "stiffness=3.1|8.3|33,preload=0.028|0.075|0.3,rest=0.01,side=1,smoothing_length=0.001"},
      {"hard_stop", "carriage",
       "cubic_stiffness=6.5e4|1.8e5|5.3e5,damping=0.12|0.32|0.95,root_damping=0.017|0.048|0.14,position=0.02,"
       "side=1,pulls=0"},
      {"hysteresis", "spring", "loss=3.6|9.9|30,rest=0,smoothing_speed=0.001"},
      {"spring", "spring", "stiffness=240|500|1000,rest=0.02"},
      {"preload", "spring", "preload=0.061|0.17|0.5"},
      {"hardening", "spring", "cubic_stiffness=5.4e3|1.5e4|4.4e4,rest=0"},
      {"unilateral_spring", "spring",
       "stiffness=4.5|12|37,preload=0.027|0.073|0.22,rest=0.01,side=1,smoothing_length=0.001"},
      {"hard_stop", "spring",
       "cubic_stiffness=4.6e4|1.7e5|5.1e5,damping=0.024|0.09|0.27,root_damping=0.0036|0.014|0.041,position=0."
       "02,side=1,pulls=0"},
      {"current_loop", "drive", "time_constant=3e-5|1e-4|3e-4,damping_ratio=0.5"},
      {"encoder_eccentricity", "height", "sine=3e-5|8e-5|2.4e-4,cosine=0,waves=100"},
      {"encoder_eccentricity", "drive", "sine=1.5e-3|4e-3|0.01,cosine=1.5e-3|4e-3|0.01,waves=1"},
      {"encoder_eccentricity", "spring", "sine=3e-5|8e-5|2.4e-4,cosine=0,waves=200"},
      {"thermal_motor", "drive",
       "magnet_sag=0,copper_sag=5e-5|2e-4|5e-4,heating=1,winding_time=20,housing_time=300,share=0.1,copper=3."
       "9e-3,ambient=293.15"},
      {"torque_ripple", "drive", "sine=6e-4|1.6e-3|5e-3,cosine=4e-4|1e-3|3e-3,cycles=12"},
      {"winding", "drive", "time_constant=3.6e-5|1e-4|3e-4,slope=1e-5|2e-5|4e-5"},
      {"harmonic_drive", "carriage",
       "stiffness_soft=6e2|2.2e2|70,stiffness_stiff=1.5e3|5.5e2|175,windup=1e-3|3e-3|9e-3,damping=0.02"},
      {"slipping_coupling", "carriage", "limit=3+1.5|1.2|0.9,stiffness=2000,damping=0.05"},
      {"torque_saturation", "drive", "sag=3e-4|8e-4|2.5e-3"},
      {"voltage_limit", "drive", "stall_torque=3+1.7|1.5|1.3,no_load_speed=200+30"},
      {"gear_efficiency", "drive",
       "loss_driving=1e-3|3e-3|0.01,loss_driven=4e-4|1.2e-3|4e-3,smoothing_speed=0.1"},
      {"asymmetric_spring", "height", "stiffness_above=0.6|1.6|5,stiffness_below=0.3|0.8|2.4,rest=0.4"},
      {"resonator", "height", "inertia=2e-3|6e-3|0.02,frequency=8,damping_ratio=0.1"},
      {"asymmetric_spring", "carriage", "stiffness_above=12|30|80,stiffness_below=6|15|40,rest=0.02"},
      {"resonator", "carriage", "inertia=2e-3|5e-3|0.014,frequency=8,damping_ratio=0.1"},
      {"asymmetric_spring", "spring", "stiffness_above=60|120|300,stiffness_below=30|60|150,rest=0.02"},
      {"resonator", "spring", "inertia=2e-3|5e-3|0.015,frequency=8,damping_ratio=0.1"},
      {"backlash", "carriage", "gap=1e-3|4e-3|0.015,stiffness=2000,damping=0.05"},
      {"cable_stretch", "carriage", "stiffness=7.9e2|2.9e2|97,damping=0.02"},
      {"added_mass", "body", "mass=0.24|0.5|1"},
      {"added_mass", "slider", "mass=0.064|0.13|0.3"},
      {"added_mass", "foot", "mass=0.028|0.06|0.12"},
      {"sensor_lag", "height", "lag=3e-5|8e-5|2.4e-4"},
      {"sensor_lag", "drive", "lag=2e-4|6e-4|1.8e-3"},
      {"sensor_lag", "spring", "lag=1e-4|3e-4|9e-4"},
      {"lost_counts", "height", "share=1e-3|3e-3|0.01,limit_speed=0.3"},
      {"lost_counts", "drive", "share=3e-3|0.01|0.03,limit_speed=5"},
      {"lost_counts", "spring", "share=3e-3|0.01|0.03,limit_speed=0.1"},
      {"encoder_offset", "height", "offset=1.5e-5|4.1e-5|0.00012"},
      {"encoder_scale", "height", "scale=1+3.7e-5|1e-4|3.1e-4"},
      {"encoder_offset", "drive", "offset=0.005|0.015|0.045"},
      {"encoder_scale", "drive", "scale=1+6e-4|1.8e-3|6e-3"},
      {"encoder_offset", "spring", "offset=1.3e-5|3.6e-5|0.00011"},
      {"encoder_scale", "spring", "scale=1+0.00087|0.0024|0.0071"},
      {"ground_stiffness_error", "toe", "scale=1+0.018|0.048|0.14"},
      {"ground_damping_error", "toe", "scale=1+0.3|0.9|3"},
      {"ground_height_error", "toe", "height=1.5e-5|4.2e-5|0.00012"},
      {"switch_lateness", "toe_switch", "closes_late=2e-3|4e-3|8e-3,opens_late=-1e-3|-3e-3|-6e-3"},
  };
  return kRows;
}

const std::vector<Row>& hopper_foreign_rows() {
  static const std::vector<Row> kRows{
      {"fading_ground", "toe_height", "share=0.1,stiffness=2e6,time=4"},
      {"warming_friction", "height", "level=0.1,gain=1"},
      {"rail_magnets", "height", "amplitude=0.5,pitch=0.02"},
  };
  return kRows;
}

}  // namespace plumbline::battery
