// Windings, joint dynamics of the skeleton, rate sensors, late switches, links without mass.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/from_data_sheets.h"
#include "simulator/model/kinds.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::HasSubstr;

constexpr const char* kArm = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="world"/>
  <link name="arm">
    <inertial><origin xyz="0 0 -0.1"/><mass value="0.5"/>
      <inertia ixx="1e-4" iyy="1e-4" izz="1e-4" ixy="0" ixz="0" iyz="0"/></inertial>
  </link>
  <link name="tool"><inertial><mass value="0"/>
      <inertia ixx="0" iyy="0" izz="0" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="hinge" type="continuous">
    <parent link="world"/><child link="arm"/><axis xyz="0 1 0"/><dynamics damping="0.02" friction="0.03"/>
  </joint>
  <joint name="flange" type="fixed"><parent link="arm"/><child link="tool"/></joint>
</robot>
)";

constexpr const char* kModel = R"(plumbline: model/1
robot: arm
skeleton: arm.urdf
coordinates:
  arm: {of: {hinge: 1}}
motors:
  drive:
    command_unit: V
    rotor_inertia: {value: 1e-4, unit: kg m^2, source: s}
    winding:
      resistance: {value: 2, unit: ohm, uncertainty: 3 %, source: sheet}
      torque_constant: {value: 0.05, unit: N m/A, uncertainty: 4 %, source: sheet}
ratios:
  arm: {motor: drive, ratio: {value: 10, unit: "1", source: s}}
feet:
  toe: {link: tool, value: [0, 0, -0.2], unit: m, source: s}
sensors:
  position: {measures: arm, resolution: {value: 1e-3, unit: rad, source: s}}
  gyro: {measures: arm, rate: true, offset: {value: 1, unit: deg/s, source: s}, noise: {value: 0.1, unit: deg/s, source: s}, source: s}
  sole: {contact: toe, threshold: {value: 15, unit: N, source: s}, closes_late: {value: 6, unit: ms, source: s}, bounce: {value: 8, unit: ms, source: s}, source: s}
)";

class DataSheets : public testing::Test {
 protected:
  Model read(const std::string& what = "", const std::string& by = "", const std::string& skeleton = kArm) {
    std::string text = kModel;
    if (!what.empty()) {
      const std::size_t at = text.find(what);
      EXPECT_NE(at, std::string::npos) << what;
      text.replace(at, what.size(), by);
    }
    folder_.write("arm.urdf", skeleton);
    return read_model(folder_.write("model.yaml", text), known_effects());
  }
  std::string refusal(const std::string& what, const std::string& by) {
    return test::refusal([&] { read(what, by); });
  }
  test::TemporaryFolder folder_;
};

// Torque = k/R (u - k v): both parts in the motor's equation.
TEST_F(DataSheets, AWindingIsAGainAndAFriction) {
  const Model model = read();
  EXPECT_NEAR(model.motors[0].torque_constant.value, 0.025, 1e-15);
  EXPECT_NEAR(model.motors[0].torque_constant.uncertainty, 0.025 * 0.05, 1e-12);  // 3-4-5
  ASSERT_EQ(model.effects.size(), 1U);
  EXPECT_EQ(model.effects[0].label(), "viscous at drive");
  EXPECT_NEAR(model.effects[0].values[0].value, 0.05 * 0.05 / 2, 1e-15);
  Plant plant(model, {});
  const double u = 7.0;
  const double v = 3.0;  // of the arm
  const Eigen::Vector2d x(0.0, v);
  Eigen::Vector2d rate;
  plant.rate(x.data(), &u, rate.data());
  const double inertia = 1e-4 + 0.5 * 0.01 + 100 * 1e-4;
  EXPECT_NEAR(rate[1], 10 * 0.05 / 2 * (u - 0.05 * 10 * v) / inertia, 1e-9);
}

// L di/dt + R i + k v = u: in the end of its rise the same torque as without inductance.
TEST_F(DataSheets, AWindingWithInductanceDelaysItsTorque) {
  const Model model =
      read("    winding:", "    winding:\n      inductance: {value: 4, unit: mH, source: sheet}");
  ASSERT_EQ(model.effects.size(), 1U);
  EXPECT_EQ(model.effects[0].label(), "winding at drive");
  EXPECT_NEAR(model.effects[0].values[0].value, 4e-3 / 2, 1e-15);
  EXPECT_NEAR(model.effects[0].values[1].value, 0.05 * 0.05 / 2, 1e-15);
  Plant plant(model, {});
  const double u = 7.0;
  const double current = 1.5;
  Eigen::Vector3d x(0.0, 3.0, 0.05 * current);
  Eigen::Vector3d rate;
  plant.rate(x.data(), &u, rate.data());
  const double inertia = 1e-4 + 0.5 * 0.01 + 100 * 1e-4;
  EXPECT_NEAR(rate[1], 10 * 0.05 * current / inertia, 1e-9);
  EXPECT_NEAR(rate[2], 0.05 * (u - 2 * current - 0.05 * 10 * 3.0) / 4e-3, 1e-9);
  plant.settle(&u, x.data());
  EXPECT_NEAR(x[2], 0.05 * u / 2, 1e-9);  // by the slope of a rate, from differences
}

TEST_F(DataSheets, ASensorOfARate) {
  const Model model = read();
  EXPECT_EQ(reading_unit(model, "gyro"), "rad/s");
  EXPECT_TRUE(model.find_sensor("position")->shows_position());
  EXPECT_FALSE(model.find_sensor("gyro")->shows_position());
  EXPECT_THAT(model.places(effects::Place::sensor), testing::ElementsAre("position"));
  Plant plant(model, {});
  const Eigen::Vector2d x(0.4, -2.0);
  Eigen::Vector2d y;
  plant.outputs(x.data(), y.data());
  const double degree = 0.017453292519943295;
  EXPECT_NEAR(y[0], 0.4, 1e-15);
  EXPECT_NEAR(y[1], -2.0 + degree, 1e-15);
  Eigen::MatrixXd C;
  plant.output_jacobian(x.data(), C);
  Eigen::Matrix2d expected;
  expected << 1, 0, 0, 1;
  EXPECT_LT((C - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_F(DataSheets, ALateSwitch) {
  const ContactSwitch& sole = read().switches.at(0);
  EXPECT_EQ(sole.threshold, 15.0);
  EXPECT_NEAR(sole.closes_late, 6e-3, 1e-15);
  EXPECT_EQ(sole.opens_late, 0.0);
  EXPECT_NEAR(sole.bounce, 8e-3, 1e-15);
}

TEST_F(DataSheets, JointDynamicsAreMentionedOrTaken) {
  const Model left = read();
  ASSERT_EQ(joint_dynamics_left(left).size(), 1U);
  EXPECT_THAT(joint_dynamics_left(left)[0],
              HasSubstr("damping 0.02 N m s/rad, friction 0.03 N m of joint hinge"));
  const Model taken = read("ratios:", "joint_dynamics: take\nratios:");
  EXPECT_TRUE(joint_dynamics_left(taken).empty());
  ASSERT_EQ(taken.effects.size(), 3U);
  EXPECT_EQ(taken.effects[1].label(), "viscous at arm");
  EXPECT_EQ(taken.effects[1].values[0].value, 0.02);
  EXPECT_EQ(taken.effects[2].label(), "coulomb at arm");
  EXPECT_EQ(taken.effects[2].values[0].value, 0.03);
}

TEST_F(DataSheets, AFixedLinkWithoutMassIsAFrame) {
  const Model model = read();
  EXPECT_EQ(model.skeleton.bodies[static_cast<std::size_t>(model.body_index("tool"))].mass, 0.0);
  std::string moving = kArm;
  moving.replace(moving.find("0.5\"/>"), 6, "0\"/>");
  EXPECT_THAT(test::refusal([&] { read("", "", moving); }), HasSubstr("expected the name of a moving joint"));
  const std::string sdf = R"(<sdf version="1.9"><model name="m">
<link name="a"><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>
<link name="b"><inertial><mass>0</mass><inertia><ixx>0</ixx><iyy>0</iyy><izz>0</izz></inertia></inertial></link>
<joint name="j" type="revolute"><parent>world</parent><child>a</child><axis><xyz>0 1 0</xyz><dynamics><damping>0.1</damping></dynamics></axis></joint>
<joint name="f" type="fixed"><parent>a</parent><child>b</child></joint></model></sdf>)";
  const Skeleton skeleton = read_skeleton(folder_.write("zero.sdf", sdf));
  EXPECT_EQ(skeleton.bodies.size(), 2U);
  EXPECT_EQ(skeleton.joints[0].damping, 0.1);
}

TEST_F(DataSheets, WhatIsRefused) {
  EXPECT_THAT(refusal("unit: ohm", "unit: V"), HasSubstr("model.yaml:11: motors.drive.winding.resistance"));
  EXPECT_THAT(refusal("command_unit: V", "command_unit: A"),
              HasSubstr("a winding of a motor whose command is in"));
  EXPECT_THAT(
      refusal("    winding:", "    torque_constant: {value: 1, unit: N m/V, source: s}\n    winding:"),
      HasSubstr("a torque constant beside a winding"));
  EXPECT_THAT(refusal("ratios:", "effects:\n  - {effect: viscous, at: drive, values: {}}\nratios:"),
              HasSubstr("which has the effect viscous, too"));
  EXPECT_THAT(refusal("ratios:", "joint_dynamics: took\nratios:"), HasSubstr("expected take or leave"));
  EXPECT_THAT(refusal("rate: true", "rate: yes"),
              HasSubstr("sensors.gyro.rate: found \"yes\", expected true or false"));
  EXPECT_THAT(refusal("noise: {value: 0.1, unit: deg/s, source: s}, ", ""),
              HasSubstr("neither resolution nor noise above zero"));
  EXPECT_THAT(refusal("unit: deg/s", "unit: deg"), HasSubstr("sensors.gyro.offset"));
  EXPECT_THAT(refusal("rate: true, ", "rate: true, counts_per_turn: 100, "),
              HasSubstr("where none are counted"));
  EXPECT_THAT(refusal("value: 15, unit: N,", "value: 15, unit: m,"), HasSubstr("sensors.sole.threshold"));
  EXPECT_THAT(refusal("value: 6, unit: ms", "value: -6, unit: ms"), HasSubstr("sensors.sole.closes_late"));
}

}  // namespace
}  // namespace plumbline::model
