// The measured EMPS axis with the controller that ran on it.
#include <gtest/gtest.h>

#include <cstdlib>

#include "simulator/model/robot_file.h"
#include "validation/identify/closed_loop/closed_loop.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class EmpsLoop : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("PLUMBLINE_EMPS_DATA") == nullptr) {
      GTEST_SKIP() << "PLUMBLINE_EMPS_DATA names no folder: the measured EMPS data are not here";
    }
  }
  void add(const std::string& effect) {
    emps.effects.push_back(parse_effect(effect, emps, effects::Catalogue::all()));
  }
  LoopError loop(const std::string& name) const {
    const Trial trial = read_trial(PLUMBLINE_ROOT "/validation/trials/emps/" + name, emps);
    const ClosedLoop result = closed_loop(emps, trial, {});
    EXPECT_EQ(result.not_available, "");
    return result.loops.at(0);
  }
  model::Model emps = model::read_model(PLUMBLINE_ROOT "/robots/emps/emps.yaml", effects::Catalogue::all());
};

// sources.md: 4 mV with the difference over two samples, and pulses of 5.0695 V where the column says 5.
TEST_F(EmpsLoop, ControllerIsKnown) {
  EXPECT_LT(loop("identification").equation_rms, 0.006);
  EXPECT_NEAR(loop("pulses").disturbance_factor, 5.0695 / 5.0, 1e-3);
}

// The benchmark's parameters leave 5.85 % and 8.94 % of the force in its authors' simulation; friction that
// depends on the direction must do better in ours. Values fitted on the identification trial alone.
TEST_F(EmpsLoop, DirectionalFrictionIsBetterThanTheBenchmarksModel) {
  const model::Model bare = emps;
  add("coulomb@carriage:level=20.3935,smoothing_speed=1e-3");
  add("torque_bias@drive:bias=3.1648");
  const double symmetric_train = loop("identification").force_percent;
  const double symmetric_pulses = loop("pulses").force_percent;
  EXPECT_LT(symmetric_train, 5.85);
  EXPECT_LT(symmetric_pulses, 8.94);
  emps = bare;
  add("coulomb@carriage:level=21.36,smoothing_speed=1e-3");
  add("viscous_directional@carriage:difference=-39.7");
  EXPECT_LT(loop("identification").force_percent, 0.9 * symmetric_train);
  EXPECT_LT(loop("pulses").force_percent, 0.9 * symmetric_pulses);
  EXPECT_LT(loop("pulses").position_percent, 0.002);
}

}  // namespace
}  // namespace plumbline::validation
