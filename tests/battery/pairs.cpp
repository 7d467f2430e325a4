#include "tests/battery/cases.h"

namespace plumbline::battery {

// Neighbours in a drive that an engineer would meet together: friction with elasticity, friction of two
// kinds, an actuator's error with friction, geometry with load, sensors with either.
const std::vector<Pair>& leg_bench_pairs() {
  static const std::vector<Pair> kPairs{
      {"coulomb@mLA", "cable_stretch@leg_angle"},
      {"coulomb@mLS", "cable_stretch@leg_shape"},
      {"cable_stretch@leg_angle", "cable_stretch@leg_shape"},
      {"coulomb@mLA", "coulomb@mLS"},
      {"coulomb@thigh", "torque_bias@mLA"},
      {"viscous_directional@mLA", "coulomb@mLS"},
      {"quadratic@mLA", "actuator_lag@mLS"},
      {"actuator_lag@mLA", "coulomb@mLA"},
      {"command_delay@mLS", "quadratic@mLS"},
      {"cogging@mLA", "coulomb@mLS"},
      {"cogging@mLS", "actuator_lag@mLA"},
      {"backlash@leg_angle", "coulomb@mLS"},
      {"backlash@leg_shape", "quadratic@mLA"},
      {"cable_stretch@leg_angle", "quadratic@mLS"},
      {"load_friction@mLA", "cable_stretch@leg_shape"},
      {"spring@thigh", "coulomb@shin"},
      {"hardening@leg_angle", "coulomb@mLS"},
      {"encoder_scale@thigh", "coulomb@mLA"},
      {"encoder_offset@knee", "actuator_lag@mLS"},
      {"gravity_tilt@world", "coulomb@mLS"},
      {"hysteresis@leg_angle", "actuator_lag@mLS"},
      {"com_shift@shin", "coulomb@mLA"},
  };
  return kPairs;
}

}  // namespace plumbline::battery
