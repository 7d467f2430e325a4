#include "tests/battery/cases.h"

namespace plumbline::battery {

// Strengths leave the model as it is with a held-out error of about 10 to 30 floors (`battery --bare
// --as-stated`; the last three of either robot in the lagrangian world).

const std::vector<Row>& leg_bench_foreign_rows() {
  static const std::vector<Row> kRows{
      {"sticky_spot", "thigh", "level=0.3,centre=0.349"},
      {"drying_bearing", "mLA", "damping=2e-4"},
      {"pressing_friction", "mLS", "damping=5e-4,waves=0.5"},
      {"thickening_oil", "mLA", "drag=2e-8"},
      {"relaxing_spring", "leg_angle", "stiffness=3"},
      {"detent", "shin", "force=0.4,centre=-0.349"},
      {"two_waves", "mLS", "force=0.02"},
      {"coarse_converter", "mLS", "step=0.6"},
      {"slewing_amplifier", "mLA", "rate=80"},
      {"eddy_brake", "mLS", "peak=0.01,speed=10"},
      {"dead_zone", "mLA", "zone=0.02"},
      {"uneven_bridge", "mLS", "share=0.007"},
      {"tilting_mount", "world", "rate=4e-3"},
      {"held_reading", "mLS", "share=0.3"},
      {"heavy_bit", "knee", "error=0.03,step=0.1"},
  };
  return kRows;
}

const std::vector<Row>& pendulum_foreign_rows() {
  static const std::vector<Row> kRows{
      {"sticky_spot", "shoulder", "level=0.025,centre=0,speed=0.005"},
      {"eddy_brake", "drive", "peak=1e-3,speed=10"},
      {"two_waves", "drive", "force=8e-4"},
      {"creeping_load", "shoulder", "mass=0.02,from=0.1,mobility=1e-3"},
      {"slow_reversal", "drive", "time=4e-3"},
      {"weakening_ends", "drive", "loss=0.05,centre=0,reach=50"},
  };
  return kRows;
}

}  // namespace plumbline::battery
