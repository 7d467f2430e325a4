#include "controllers/mabel_hopping/hopping_config.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "controllers/mabel_hopping/hopping.h"
#include "tests/controllers/hopping_example.h"

namespace plumbline::controllers {
namespace {

// What the constructor says about the example with one change; empty: nothing.
std::string complaint(const std::function<void(HoppingConfig&)>& change) {
  HoppingConfig config = hopping_example();
  change(config);
  try {
    const Hopping controller(config);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(HoppingConfig, TheExampleIsTaken) {
  EXPECT_EQ(complaint([](HoppingConfig&) {}), "");
  EXPECT_THROW(Hopping(HoppingConfig{}), std::invalid_argument);  // there are no hidden values to run with
}

TEST(HoppingConfig, EveryNumberMustBeFinite) {
  using P = HoppingParameters;
  for (double P::*member : {&P::delta_LA, &P::h_T0, &P::h_LS_left, &P::h_LS_right, &P::delta_LS_minus_left,
                            &P::delta_LS_minus_right, &P::delta_LS_plus_left, &P::delta_LS_plus_right,
                            &P::gamma_LA_to_mLA, &P::gamma_LS_to_mLS, &P::hip_velocity_band, &P::retract_time,
                            &P::K_T, &P::delta_phi_d, &P::delta_h_T_limit}) {
    EXPECT_NE(complaint([&](HoppingConfig& c) { c.parameters.*member = std::nan(""); }), "");
    EXPECT_NE(complaint([&](HoppingConfig& c) { c.parameters.*member = HUGE_VAL; }), "");
  }
  using G = HoppingLegGains;
  for (double G::*member : {&G::kp_LA, &G::kd_LA, &G::kp_mLS, &G::kd_mLS}) {
    EXPECT_NE(complaint([&](HoppingConfig& c) { c.left.*member = HUGE_VAL; }), "");
    EXPECT_NE(complaint([&](HoppingConfig& c) { c.right.*member = -1.0; }), "");
  }
  using R = HoppingResolutions;
  for (double R::*member : {&R::mLA, &R::mLS, &R::thigh, &R::knee, &R::torso, &R::tower, &R::boom_pitch}) {
    EXPECT_NE(complaint([&](HoppingConfig& c) { c.resolution.*member = 0.0; }), "");
    EXPECT_NE(complaint([&](HoppingConfig& c) { c.resolution.*member = std::nan(""); }), "");
    EXPECT_EQ(complaint([&](HoppingConfig& c) { c.resolution.*member *= -1.0; }), "");
  }
}

TEST(HoppingConfig, RangesAreKept) {
  const std::vector<std::function<void(HoppingConfig&)>> wrong = {
      [](HoppingConfig& c) { c.period = 0.0; },
      [](HoppingConfig& c) { c.boom_length = -2.25; },
      [](HoppingConfig& c) { c.parameters.gamma_LA_to_mLA = 0.0; },
      [](HoppingConfig& c) { c.parameters.gamma_LS_to_mLS = 0.0; },
      [](HoppingConfig& c) { c.parameters.hip_velocity_band = -0.01; },
      [](HoppingConfig& c) { c.parameters.retract_time = 0.0; },
      [](HoppingConfig& c) { c.parameters.delta_h_T_limit = 0.0; },
      [](HoppingConfig& c) { c.torque_limit_mLA = 0.0; },
      [](HoppingConfig& c) { c.torque_limit_mLS = HUGE_VAL; },
      [](HoppingConfig& c) { c.leg_angle_filter.samples = 1; },
      [](HoppingConfig& c) { c.leg_shape_filter.order = 3; },
      [](HoppingConfig& c) { c.hip_filter.time_constant = -1.0; },
      [](HoppingConfig& c) { c.supplements.contact_samples = 0; },
      [](HoppingConfig& c) { c.supplements.touchdown_time_min = -1e-3; },
      [](HoppingConfig& c) { c.supplements.bounce_time = std::nan(""); },
      [](HoppingConfig& c) { c.supplements.kickoff_time_max = HUGE_VAL; },
      [](HoppingConfig& c) { c.supplements.liftoff_time_max = -1.0; },
      [](HoppingConfig& c) { c.workspace.leg_angle_to = c.workspace.leg_angle_from; },
      [](HoppingConfig& c) { c.workspace.leg_shape_from = std::nan(""); },
  };
  for (std::size_t k = 0; k < wrong.size(); ++k) EXPECT_NE(complaint(wrong[k]), "") << "change " << k;
  EXPECT_EQ(complaint([](HoppingConfig& c) {
              c.parameters.event_update = false;
              c.parameters.delta_h_T_limit = 0.0;
            }),
            "");
}

TEST(HoppingConfig, TheComplaintNamesTheValue) {
  EXPECT_EQ(complaint([](HoppingConfig& c) { c.parameters.delta_LA = std::nan(""); }),
            "hopping: delta_LA must be finite");
}

}  // namespace
}  // namespace plumbline::controllers
