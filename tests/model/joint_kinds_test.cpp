// Ball, universal, planar and floating joints: where they put a link, and a conical pendulum.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/body_poses.h"
#include "simulator/model/kinds.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/model/floating_states.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using Eigen::AngleAxisd;
using Eigen::Vector3d;
using testing::HasSubstr;
using Names = std::vector<std::string>;

constexpr double kLength = 0.7;  // m, from the joint down to the bob
constexpr double kGravity = 9.81;

/// A bob on a rod without mass; the joint is at the link's origin, 2 m high and turned about z.
std::string pendulum(const std::string& joint) {
  return R"(<sdf version="1.9"><model name="pendulum">
  <link name="bob"><pose>0 0 2 0 0 0.4</pose>
    <inertial><pose>0 0 -0.7 0 0 0</pose><mass>1.5</mass>
      <inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial></link>
  )" + joint +
         "</model></sdf>";
}

constexpr const char* kBall =
    R"(<joint name="joint" type="ball"><parent>world</parent><child>bob</child></joint>)";
constexpr const char* kUniversal =
    R"(<joint name="joint" type="universal"><parent>world</parent><child>bob</child>
    <axis><xyz>1 0 0</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>)";

std::string puck(const std::string& type, const std::string& axis) {
  return R"(<robot name="puck"><link name="table"/>
  <link name="puck"><inertial><mass value="0.5"/><inertia ixx="0.1" iyy="0.1" izz="0.15" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="slide" type=")" +
         type + R"("><parent link="table"/><child link="puck"/><origin xyz="0 0 1" rpy="0 0 0.3"/>)" + axis +
         "</joint></robot>";
}

class JointKinds : public testing::Test {
 protected:
  static Eigen::Isometry3d last_pose(const Skeleton& skeleton, const Eigen::VectorXd& q) {
    return body_poses(skeleton, q).back();
  }
  Skeleton read(const std::string& name, const std::string& text) const {
    return read_skeleton(folder_.write(name, text));
  }
  test::TemporaryFolder folder_;
  const Eigen::Matrix3d turned_ = AngleAxisd(0.4, Vector3d::UnitZ()).toRotationMatrix();
};

TEST_F(JointKinds, ABallTurnsByYawPitchAndRollInItsOwnFrame) {
  const Skeleton skeleton = read("ball.sdf", pendulum(kBall));
  EXPECT_EQ(joint_names(skeleton), (Names{"joint_yaw", "joint_pitch", "joint_roll"}));
  EXPECT_EQ(skeleton.charts, (std::vector<int>{1}));
  const Vector3d angles(0.3, -0.5, 0.8);
  const Eigen::Isometry3d X = last_pose(skeleton, angles);
  EXPECT_LT((X.linear() - turned_ * test::rotation_of(angles)).norm(), 1e-12);
  EXPECT_LT((X.translation() - Vector3d(0, 0, 2)).norm(), 1e-12);
}

TEST_F(JointKinds, AUniversalJointCarriesItsSecondAxisAlong) {
  const Skeleton skeleton = read("universal.sdf", pendulum(kUniversal));
  EXPECT_EQ(joint_names(skeleton), (Names{"joint_1", "joint_2"}));
  EXPECT_FALSE(skeleton.floats());
  const Eigen::Isometry3d X = last_pose(skeleton, Eigen::Vector2d(0.3, -0.5));
  EXPECT_LT((X.linear() - turned_ * AngleAxisd(0.3, Vector3d::UnitX()).toRotationMatrix() *
                              AngleAxisd(-0.5, Vector3d::UnitY()).toRotationMatrix())
                .norm(),
            1e-12);
}

// At the angle theta from the vertical it circles with Omega^2 = g/(l cos theta), and nothing else changes
// (the bob's own moments are alike in all directions: it turns with the rod and needs no torque).
TEST_F(JointKinds, AConicalPendulumCircles) {
  folder_.write("ball.sdf", pendulum(kBall));
  const Model model = read_model(folder_.write("model.yaml",
                                               "plumbline: model/1\nrobot: cone\nskeleton: ball.sdf\n"
                                               "gravity: {value: 9.81, unit: m/s^2, assumed: test}\n"),
                                 known_effects());
  Plant plant(model, {});
  constexpr double kAngle = 0.6;
  Eigen::VectorXd x(6), rate(6);
  x << 1.1, kAngle, 0.0, std::sqrt(kGravity / (kLength * std::cos(kAngle))), 0.0, 0.0;
  plant.rate(x.data(), nullptr, rate.data());
  EXPECT_LT(rate.tail(3).cwiseAbs().maxCoeff(), 1e-11);
  x[3] *= 1.01;
  plant.rate(x.data(), nullptr, rate.data());
  EXPECT_GT(rate[4], 0.05);  // faster: it rises
}

TEST_F(JointKinds, APlanarJointSlidesAcrossItsNormalAndTurnsAboutIt) {
  const Skeleton skeleton = read("puck.urdf", puck("planar", "<axis xyz='0 0 1'/>"));
  EXPECT_EQ(joint_names(skeleton), (Names{"slide_x", "slide_y", "slide_turn"}));
  const Eigen::Isometry3d X = last_pose(skeleton, Vector3d(0.5, -0.2, 0.9));
  const Vector3d expected = AngleAxisd(0.3, Vector3d::UnitZ()) * Vector3d(0.5, -0.2, 0.0) + Vector3d::UnitZ();
  EXPECT_LT((X.translation() - expected).norm(), 1e-12);
  EXPECT_LT((X.linear() - AngleAxisd(1.2, Vector3d::UnitZ()).toRotationMatrix()).norm(), 1e-12);
  const Skeleton wall = read("wall.urdf", puck("planar", "<axis xyz='1 0 0'/>"));
  EXPECT_LT(std::abs(last_pose(wall, Vector3d(0.5, -0.2, 0.0))
                         .translation()
                         .dot(Vector3d(std::cos(0.3), std::sin(0.3), 0.0))),
            1e-12);
  EXPECT_THAT(test::refusal([&] { read("bad.urdf", puck("planar", "<axis xyz='0 0'/>")); }),
              HasSubstr("slide axis: found \"0 0\", expected three numbers"));
}

// Its coordinates are the link's place in the world, whatever pose the joint has in the file.
TEST_F(JointKinds, AFloatingJointOnTheWorldIsTheBase) {
  const Skeleton skeleton = read("puck.urdf", puck("floating", ""));
  EXPECT_EQ(joint_names(skeleton),
            (Names{"base_x", "base_y", "base_z", "base_yaw", "base_pitch", "base_roll"}));
  Eigen::VectorXd q(6);
  q << 1.0, 2.0, 3.0, 0.3, -0.5, 0.8;
  const Eigen::Isometry3d X = last_pose(skeleton, q);
  EXPECT_LT((X.translation() - Vector3d(1, 2, 3)).norm(), 1e-12);
  EXPECT_LT((X.linear() - test::rotation_of({0.3, -0.5, 0.8})).norm(), 1e-12);
}

TEST_F(JointKinds, WhatIsNotKnownIsRefused) {
  const auto refusal = [&](const std::string& name, const std::string& text) {
    return test::refusal([&] { read(name, text); });
  };
  EXPECT_THAT(
      refusal("screw.sdf", pendulum(R"(<joint name="joint" type="screw"/>)")),
      HasSubstr("joint: found joint type \"screw\", expected revolute, continuous, prismatic, fixed, ball or "
                "universal"));
  EXPECT_THAT(refusal("ball.urdf", puck("ball", "")), HasSubstr("floating or planar"));
}

}  // namespace
}  // namespace plumbline::model
