// Controllers as shared libraries: the same numbers as the class behind them, and one line for each that
// cannot be used.
#include "controllers/host/loaded_controller.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>

#include "controllers/mabel_hopping/hopping.h"
#include "tests/controllers/hopping_example.h"

namespace plumbline::controllers {
namespace {

std::string library(const std::string& name) { return find_controller(name); }
std::string broken(const std::string& name) { return std::string(BROKEN_CONTROLLERS) + "/" + name + ".so"; }

std::string error_of(const std::string& path) {
  try {
    const LoadedController loaded(path);
  } catch (const ControllerError& error) {
    return error.what();
  }
  return "";
}

double value_in_example(const std::string& name, const HoppingConfig& c) {
  const HoppingParameters& p = c.parameters;
  const std::map<std::string, double> values{{"boom_length", c.boom_length},
                                             {"torque_limit_mLA", c.torque_limit_mLA},
                                             {"torque_limit_mLS", c.torque_limit_mLS},
                                             {"delta_LA", p.delta_LA},
                                             {"h_T0", p.h_T0},
                                             {"h_LS_left", p.h_LS_left},
                                             {"h_LS_right", p.h_LS_right},
                                             {"delta_LS_minus_left", p.delta_LS_minus_left},
                                             {"delta_LS_minus_right", p.delta_LS_minus_right},
                                             {"delta_LS_plus_left", p.delta_LS_plus_left},
                                             {"delta_LS_plus_right", p.delta_LS_plus_right},
                                             {"gamma_LA_to_mLA", p.gamma_LA_to_mLA},
                                             {"gamma_LS_to_mLS", p.gamma_LS_to_mLS},
                                             {"hip_velocity_band", p.hip_velocity_band},
                                             {"retract_time", p.retract_time},
                                             {"event_update", 1.0},
                                             {"K_T", p.K_T},
                                             {"delta_phi_d", p.delta_phi_d},
                                             {"delta_h_T_limit", p.delta_h_T_limit},
                                             {"kp_LA_left", c.left.kp_LA},
                                             {"kd_LA_left", c.left.kd_LA},
                                             {"kp_mLS_left", c.left.kp_mLS},
                                             {"kd_mLS_left", c.left.kd_mLS},
                                             {"kp_LA_right", c.right.kp_LA},
                                             {"kd_LA_right", c.right.kd_LA},
                                             {"kp_mLS_right", c.right.kp_mLS},
                                             {"kd_mLS_right", c.right.kd_mLS},
                                             {"leg_angle_samples", 2.0},
                                             {"leg_angle_order", 1.0},
                                             {"leg_shape_samples", 2.0},
                                             {"leg_shape_order", 1.0},
                                             {"hip_samples", 2.0},
                                             {"hip_order", 1.0},
                                             {"contact_samples", 1.0},
                                             {"leg_angle_from", -INFINITY},
                                             {"leg_angle_to", INFINITY},
                                             {"leg_shape_from", -INFINITY},
                                             {"leg_shape_to", INFINITY}};
  const auto found = values.find(name);
  return found == values.end() ? 0.0 : found->second;
}

std::vector<double> example_constants(const LoadedController& loaded) {
  std::vector<double> constants;
  for (const plumbline_port& port : loaded.constants()) {
    constants.push_back(value_in_example(port.name, hopping_example()));
  }
  return constants;
}

std::vector<double> example_scales() {
  const HoppingResolutions r = hopping_example().resolution;
  return {r.mLA,  r.mLS,   r.thigh, r.knee,       r.mLA, r.mLS, r.thigh,
          r.knee, r.torso, r.tower, r.boom_pitch, 1.0,   1.0};
}

TEST(LoadedController, GivesWhatTheClassBehindItGives) {
  const LoadedController loaded(library("mabel_hopping"));
  EXPECT_STREQ(loaded.api().name, "mabel_hopping");
  ControllerInstance instance(loaded, 1e-3, example_constants(loaded), example_scales());
  Hopping direct(hopping_example());
  std::vector<double> in(13), out(4), log(loaded.log().size());
  for (int k = 0; k < 1200; ++k) {
    const int t = k % 400;
    HoppingSample sample;
    sample.left = {-k, 3 * k % 500, 5 * k % 900, -k % 300};
    sample.right = {k, 2 * k % 400, 7 * k % 900, -k % 200};
    sample.torso = k % 70;
    sample.tower = -9 * k;
    sample.boom_pitch = t < 180 ? -3 * t : 2 * t - 900;
    sample.left_contact = t >= 100 && t < 250;
    sample.right_contact = t >= 105 && t < 255;
    const HoppingTorques wanted = direct.command(sample);
    const auto d = [](std::int64_t counts) { return static_cast<double>(counts); };
    in = {d(sample.left.mLA),
          d(sample.left.mLS),
          d(sample.left.thigh),
          d(sample.left.knee),
          d(sample.right.mLA),
          d(sample.right.mLS),
          d(sample.right.thigh),
          d(sample.right.knee),
          d(sample.torso),
          d(sample.tower),
          d(sample.boom_pitch),
          sample.left_contact ? 1.0 : 0.0,
          sample.right_contact ? 1.0 : 0.0};
    ASSERT_EQ(instance.step(in.data(), out.data(), log.data()), 0);
    EXPECT_THAT(out,
                testing::ElementsAre(wanted.mLA_left, wanted.mLS_left, wanted.mLA_right, wanted.mLS_right));
    EXPECT_EQ(log[0], static_cast<double>(direct.phase()));
    EXPECT_EQ(log[1], direct.h_T_d());
  }
  EXPECT_GT(direct.hops(), 0);
}

TEST(LoadedController, WhatOutlastsAHopCanBeSet) {
  const LoadedController loaded(library("mabel_hopping"));
  ControllerInstance instance(loaded, 1e-3, example_constants(loaded), example_scales());
  instance.set_memory({0.1, 0.5, 1.0});
  const std::vector<double> memory = instance.memory();
  EXPECT_EQ(memory[0], 0.1);
  EXPECT_NEAR(memory[1], 0.5, hopping_example().resolution.tower);
  EXPECT_EQ(memory[2], 1.0);
  instance.reset();
  EXPECT_EQ(instance.memory()[0], 0.140);
}

TEST(LoadedController, ItsIdentityIsTheFilesHash) {
  // FIPS 180-2, appendix B.1: "abc".
  const std::string path = testing::TempDir() + "abc.txt";
  std::ofstream(path) << "abc";
  EXPECT_EQ(sha256_of_file(path), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  std::remove(path.c_str());
  EXPECT_EQ(LoadedController(library("hold_position")).sha256(), sha256_of_file(library("hold_position")));
}

TEST(LoadedController, WhatCannotBeUsedIsSaidInOneLine) {
  EXPECT_THAT(error_of("/nowhere/x.so"), testing::HasSubstr("no file that can be read"));
  EXPECT_THAT(error_of(__FILE__), testing::HasSubstr("does not load"));
  EXPECT_THAT(error_of(broken("other_version")),
              testing::HasSubstr("found interface version 2, expected version 1"));
  EXPECT_THAT(error_of(broken("no_function")), testing::HasSubstr("no function plumbline_controller"));
  EXPECT_THAT(error_of(broken("twice")), testing::HasSubstr("port q twice among the inputs"));
  for (const char* name : {"other_version", "no_function", "twice"}) {
    EXPECT_EQ(error_of(broken(name)).find('\n'), std::string::npos);
  }
  EXPECT_EQ(find_controller("no_such_controller"), "");
}

TEST(LoadedController, ConstantsAreHeldAgainstTheirLimits) {
  const LoadedController loaded(library("mabel_hopping"));
  std::vector<double> constants = example_constants(loaded);
  constants[1] = 31.0;  // torque_limit_mLA
  EXPECT_THROW(ControllerInstance(loaded, 1e-3, constants, example_scales()), ControllerError);
  constants = example_constants(loaded);
  constants[0] = -1.0;  // the boom's length: the controller's own check
  try {
    ControllerInstance(loaded, 1e-3, constants, example_scales());
    FAIL();
  } catch (const ControllerError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("boom_length must be finite and positive"));
  }
}

/// The example in C: a spring and a damper in software.
TEST(HoldPosition, IsThePdThatItsCommentStates) {
  const LoadedController loaded(library("hold_position"));
  ControllerInstance instance(loaded, 0.002, {0.5, 10.0, 0.3}, {0.01});
  double out = 0.0;
  double log = 0.0;
  double in = 20.0;  // 0.2 rad
  EXPECT_EQ(instance.step(&in, &out, &log), 0);
  EXPECT_DOUBLE_EQ(out, 10.0 * 0.3);  // no rate is known yet
  in = 21.0;
  instance.step(&in, &out, &log);
  EXPECT_NEAR(out, 10.0 * 0.29 - 0.3 * 0.01 / 0.002, 1e-12);
  EXPECT_NEAR(log, 0.29, 1e-12);
  in = -1e6;
  instance.step(&in, &out, nullptr);
  EXPECT_EQ(out, 30.0);
}

}  // namespace
}  // namespace plumbline::controllers
