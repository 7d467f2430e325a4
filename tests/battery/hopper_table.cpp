#include "tests/battery/cases.h"

namespace plumbline::battery {

const std::vector<Row>& hopper_rows() {
  static const std::vector<Row> kRows{};
  return kRows;
}

const std::vector<Row>& hopper_foreign_rows() {
  static const std::vector<Row> kRows{
      {"fading_ground", "toe_height", "share=0.5,stiffness=2e6,time=4"},
      {"warming_friction", "height", "level=0.6,gain=0.5"},
      {"rail_magnets", "height", "amplitude=1.5,pitch=0.02"},
  };
  return kRows;
}

}  // namespace plumbline::battery
