#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "tests/model/robot_texts.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::HasSubstr;

// The arm of kUrdf as SDFormat.
constexpr const char* kSdf = R"(<?xml version="1.0"?>
<sdf version="1.9">
  <world name="w">
    <gravity>1 0 -2</gravity>
    <model name="arm">
      <pose>0 0 5 0 0 0</pose>
      <link name="load">
        <pose relative_to="arm">0.2 0 0 0 0 0</pose>
        <inertial><mass>3</mass><inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz></inertia></inertial>
      </link>
      <link name="base"/>
      <link name="arm">
        <pose relative_to="turn"/>
        <inertial>
          <pose>0.1 0 0 0 0 0.5</pose><mass>2</mass>
          <inertia><ixx>0.1</ixx><iyy>0.2</iyy><izz>0.25</izz></inertia>
        </inertial>
      </link>
      <joint name="weld" type="fixed"><pose>0 0 0.3 0 0 0</pose><parent>arm</parent><child>load</child></joint>
      <joint name="turn" type="revolute">
        <pose relative_to="base">0 0 1 0.3 0 0</pose><parent>base</parent><child>arm</child>
        <axis><xyz>0 2 0</xyz></axis>
      </joint>
    </model>
  </world>
</sdf>
)";

class SkeletonTest : public testing::Test {
 protected:
  Skeleton read(const std::string& name, const std::string& text) const {
    return read_skeleton(folder_.write(name, text));
  }
  test::TemporaryFolder folder_;
};

void expect_arm(const Skeleton& skeleton, std::size_t arm, std::size_t load) {
  const Body& body = skeleton.bodies[arm];
  EXPECT_EQ(body.name, "arm");
  EXPECT_EQ(body.mass, 2.0);
  EXPECT_TRUE(body.com.isApprox(Eigen::Vector3d(0.1, 0, 0)));
  // Rotation by a about z: Ixx' = Ixx cos^2 a + Iyy sin^2 a, Ixy' = (Ixx - Iyy) sin a cos a
  // (Featherstone, Rigid Body Dynamics Algorithms, 2008, section 2.13).
  const double c = std::cos(0.5);
  const double s = std::sin(0.5);
  EXPECT_NEAR(body.inertia(0, 0), 0.1 * c * c + 0.2 * s * s, 1e-14);
  EXPECT_NEAR(body.inertia(1, 1), 0.1 * s * s + 0.2 * c * c, 1e-14);
  EXPECT_NEAR(body.inertia(0, 1), (0.1 - 0.2) * s * c, 1e-14);
  EXPECT_NEAR(body.inertia(2, 2), 0.25, 1e-14);
  const Joint& turn = skeleton.joints[arm];
  EXPECT_EQ(turn.name, "turn");
  EXPECT_EQ(turn.type, JointType::revolute);
  EXPECT_EQ(turn.axis, Eigen::Vector3d::UnitY());
  EXPECT_TRUE(turn.X_PJ.translation().isApprox(Eigen::Vector3d(0, 0, 1)));
  EXPECT_TRUE(
      turn.X_PJ.linear().isApprox(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()).toRotationMatrix()));
  EXPECT_TRUE(turn.X_CJ.isApprox(Eigen::Isometry3d::Identity()));
  const Joint& weld = skeleton.joints[load];
  EXPECT_EQ(weld.type, JointType::fixed);
  EXPECT_EQ(weld.parent, static_cast<int>(arm));
  EXPECT_EQ(skeleton.bodies[load].mass, 3.0);
  const Eigen::Isometry3d X_PC = weld.X_PJ * weld.X_CJ.inverse();
  EXPECT_TRUE(X_PC.translation().isApprox(Eigen::Vector3d(0.2, 0, 0)));
}

void expect_tree(const Skeleton& skeleton) {
  ASSERT_EQ(skeleton.joints.size(), skeleton.bodies.size());
  for (std::size_t i = 0; i < skeleton.joints.size(); ++i) {
    EXPECT_EQ(skeleton.joints[i].child, static_cast<int>(i));
    EXPECT_LT(skeleton.joints[i].parent, static_cast<int>(i));
  }
}

TEST_F(SkeletonTest, AJointOfAUrdfMayBeCalledAsALinkIs) {
  const Skeleton skeleton = read("arm.urdf", R"(<robot name="arm">
  <link name="base"/>
  <link name="arm"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.05"/></inertial></link>
  <joint name="arm" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>
  <link name="tool"><inertial><mass value="1"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.05"/></inertial></link>
  <joint name="tool" type="fixed"><parent link="arm"/><child link="tool"/></joint>
</robot>)");
  ASSERT_EQ(skeleton.joints.size(), 3U);
  EXPECT_EQ(skeleton.joints[1].name, "arm");
  EXPECT_EQ(skeleton.joints[1].type, JointType::revolute);
  EXPECT_EQ(skeleton.joints[2].name, "tool");
}

TEST_F(SkeletonTest, AWorldThatJointsHangOnNeedNotBeStated) {
  const Skeleton skeleton = read("hanging.urdf", R"(<robot name="hanging">
  <link name="arm"><inertial><origin xyz="0 0 -0.3"/><mass value="2"/>
    <inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.05"/></inertial></link>
  <joint name="pivot" type="continuous"><parent link="world"/><child link="arm"/><axis xyz="0 1 0"/></joint>
</robot>)");
  ASSERT_EQ(skeleton.joints.size(), 1U);
  EXPECT_EQ(skeleton.joints[0].name, "pivot");
  EXPECT_EQ(skeleton.bodies[static_cast<std::size_t>(skeleton.joints[0].child)].name, "arm");
}

TEST_F(SkeletonTest, ReadsUrdfAndKeepsEveryLink) {
  const Skeleton skeleton = read("arm.urdf", test::kUrdf);
  ASSERT_EQ(skeleton.bodies.size(), 4U);
  expect_tree(skeleton);
  EXPECT_EQ(skeleton.bodies[0].name, "base");
  EXPECT_EQ(skeleton.bodies[0].mass, 0.0);
  EXPECT_EQ(skeleton.joints[0].parent, -1);
  EXPECT_EQ(skeleton.joints[0].type, JointType::fixed);
  expect_arm(skeleton, 1, 2);
  EXPECT_EQ(skeleton.bodies[3].name, "tool");
  EXPECT_EQ(skeleton.bodies[3].mass, 0.0);
  EXPECT_EQ(skeleton.gravity, Eigen::Vector3d(0, 0, -9.80665));
}

TEST_F(SkeletonTest, ReadsSdformatInTreeOrder) {
  const Skeleton skeleton = read("arm.sdf", kSdf);
  ASSERT_EQ(skeleton.bodies.size(), 3U);
  expect_tree(skeleton);
  EXPECT_EQ(skeleton.bodies[0].name, "base");
  EXPECT_TRUE(skeleton.joints[0].X_PJ.translation().isApprox(Eigen::Vector3d(0, 0, 5)));
  expect_arm(skeleton, 1, 2);
  EXPECT_EQ(skeleton.gravity, Eigen::Vector3d(1, 0, -2));
}

TEST_F(SkeletonTest, JointsToTheWorldKeepTheirType) {
  const Skeleton skeleton = read("arm.sdf", test::kSkeleton);
  ASSERT_EQ(skeleton.bodies.size(), 3U);
  EXPECT_EQ(skeleton.joints[0].type, JointType::prismatic);
  EXPECT_EQ(skeleton.joints[0].parent, -1);
  EXPECT_EQ(skeleton.joints[2].parent, 1);
  EXPECT_TRUE(skeleton.joints[2].X_PJ.translation().isApprox(Eigen::Vector3d(0, 0, -0.5)));
}

TEST_F(SkeletonTest, AUrdfRootNamedWorldIsTheWorld) {
  std::string text = test::kUrdf;
  for (std::size_t at = text.find("\"base\""); at != std::string::npos; at = text.find("\"base\"")) {
    text.replace(at, 6, "\"world\"");
  }
  const Skeleton skeleton = read("arm.urdf", text);
  ASSERT_EQ(skeleton.bodies.size(), 3U);
  expect_tree(skeleton);
  EXPECT_EQ(skeleton.joints[0].parent, -1);
  expect_arm(skeleton, 0, 1);
}

// A URDF's frame or sensor whose inertia no body has: it is taken as it is where what it is fixed to makes a
// body of both, and said; what moves alone with a moment below zero is refused.
TEST_F(SkeletonTest, AUrdfsImpossibleInertiaIsJudgedWithWhatItIsFixedTo) {
  const auto with = [](const std::string& inertia, bool fixed) {
    std::string text = test::kUrdf;
    const std::string load = "<mass value=\"3\"/><inertia ixx=\"0.1\" iyy=\"0.2\" izz=\"0.25\"";
    text.replace(text.find(load), load.size(),
                 "<origin rpy=\"0 0 1\"/><mass value=\"3\"/><inertia " + inertia);
    if (!fixed) {
      text.replace(text.find("type=\"fixed\""), 12, "type=\"continuous\"");
    }
    return text;
  };
  const Skeleton arm = read("arm.urdf", with("ixx=\"-0.01\" iyy=\"0.2\" izz=\"0.9\"", true));
  const auto load = std::find_if(arm.bodies.begin(), arm.bodies.end(),
                                 [](const Body& body) { return body.name == "load"; });
  ASSERT_NE(load, arm.bodies.end());
  EXPECT_NEAR(load->inertia(2, 2), 0.9, 1e-15);
  EXPECT_NEAR(load->inertia.trace(), 1.09, 1e-12);
  EXPECT_NEAR(load->inertia(0, 0), -0.01 * std::pow(std::cos(1.0), 2) + 0.2 * std::pow(std::sin(1.0), 2),
              1e-12);
  EXPECT_THAT(arm.left_out, testing::Contains(HasSubstr("The inertia of link load, which no body has")));
  EXPECT_THAT(read("arm.urdf", with("ixx=\"0.1\" iyy=\"0.2\" izz=\"0.9\"", false)).left_out,
              testing::Contains(HasSubstr("link load")));
  EXPECT_THAT(test::refusal([&] { read("arm.urdf", with("ixx=\"-0.01\" iyy=\"0.2\" izz=\"0.25\"", false)); }),
              HasSubstr("arm.urdf:11: load inertia: found a principal moment of -0.01 kg m^2 of it and what "
                        "is fixed to it"));
}

TEST_F(SkeletonTest, AUrdfsJointThatCarriesNoMassIsHeld) {
  std::string text = test::kUrdf;
  const std::string flange = "<joint name=\"flange\" type=\"fixed\">";
  text.replace(text.find(flange), flange.size(), "<joint name=\"flange\" type=\"continuous\">");
  const Skeleton arm = read("arm.urdf", text);
  const auto held = std::find_if(arm.joints.begin(), arm.joints.end(),
                                 [](const Joint& joint) { return joint.name == "flange"; });
  ASSERT_NE(held, arm.joints.end());
  EXPECT_EQ(held->type, JointType::fixed);
  EXPECT_THAT(arm.left_out, testing::Contains(HasSubstr("Joint flange of link tool, which carries nothing")));
}

struct Bad {
  std::string text, from, to;
  int line;
  std::string key, found, expected;
};

TEST_F(SkeletonTest, RefusesBadSkeletonsInOneLine) {
  const std::string sdf = test::kSkeleton;
  const std::string urdf = test::kUrdf;
  const std::vector<Bad> table{
      {sdf, "<mass>4</mass>", "<mass>-4</mass>", 6, "cart mass", "-4 kg", "a mass above zero"},
      {sdf, "<mass>4</mass>", "<mass>four</mass>", 6, "cart mass", "\"four\"", "a finite number"},
      {sdf, "<mass>4</mass>", "", 5, "cart mass", "no value", "a number"},
      {sdf, "<ixx>0.04</ixx>", "", 14, "upper ixx", "no value", "a number"},
      {sdf, "<ixx>0.04</ixx>", "<ixx>-0.04</ixx>", 14, "upper inertia", "a principal moment of -0.04",
       "above zero"},
      {sdf, "<ixx>0.04</ixx>", "<ixx>0.4</ixx>", 14, "upper inertia", "principal moments 0.01, 0.04, 0.4",
       "sum of the other two"},
      {sdf, "<inertia><ixx>0.04</ixx><iyy>0.04</iyy><izz>0.01</izz></inertia>", "", 11, "upper inertia",
       "no inertia", "ixx"},
      {sdf, "type=\"prismatic\"", "type=\"screw\"", 25, "rail", "joint type \"screw\"",
       "revolute, continuous, prismatic, fixed, ball or universal"},
      {sdf, "<joint name=\"elbow\"", "<joint name=\"rail\"", 35, "rail", "a second joint of this name",
       "once"},
      {sdf, "<link name=\"lower\">", "<link name=\"upper\">", 17, "upper", "a second link of this name",
       "once"},
      {sdf, "<link name=\"lower\">", "<link>", 17, "link", "no name", "name"},
      {sdf, "<parent>upper</parent>", "<parent>uper</parent>", 35, "elbow", "", "libsdformat"},
      {sdf, "<joint name=\"elbow\"",
       "<joint name=\"b\" type=\"prismatic\"><parent>world</parent><child>upper</child><axis><xyz>1 0 0</xyz>"
       "</axis></joint><joint name=\"elbow\"",
       35, "b", "link upper as the child of a second joint (a closed loop) that is prismatic",
       "revolute, ball or fixed"},
      {sdf, "<parent>cart</parent>", "<parent>lower</parent>", 10, "upper", "a link that no chain of joints",
       "floating_base: true"},
      {sdf, "<axis><xyz>1 0 0</xyz></axis>", "", 25, "rail", "", "expected"},
      {sdf, "<link name=\"cart\">", "<model name=\"x\"><link name=\"y\"/></model><link name=\"cart\">", 4,
       "x", "a model inside", "links and joints only"},
      {sdf, "<link name=\"cart\">", "<include><uri>model://x</uri></include><link name=\"cart\">", 4,
       "include", "an included model", "one file"},
      {sdf, "</sdf>", "<model name=\"b\"><link name=\"c\"/></model></sdf>", 2, "", "0 worlds and 2 models",
       "one model"},
      {sdf, "</model>", "", 3, "", "text that is no XML", "a whole"},
      {urdf, "type=\"continuous\"", "type=\"ball\"", 15, "turn", "joint type \"ball\"", "floating or planar"},
      {urdf, "<axis xyz=\"0 2 0\"/>", "<axis xyz=\"0 2 0\"/><mimic joint=\"x\"/>", 15, "turn mimic", "\"x\"",
       "a moving joint that mimics none"},
      {urdf, "<mass value=\"2\"/>", "<mass value=\"-2\"/>", 6, "arm mass", "-2 kg", "above zero"},
      {urdf, "<mass value=\"2\"/>", "<mass/>", 6, "arm mass", "no value", "a number"},
      {urdf, "iyz=\"0\"", "", 7, "arm iyz", "no value", "a number"},
      {urdf, "<child link=\"load\"/>", "<child link=\"laod\"/>", 18, "weld child", "\"laod\"",
       "did you mean load?"},
      {urdf, "<joint name=\"weld\" type=\"fixed\">", "<joint name=\"weld\" type=\"revolute\">", 0, "", "",
       "expected"},
      {"<a/>", "<a/>", "<b/>", 1, "", "root element <b>", "<sdf> or <robot>"},
      {"<robot name='a'/>", "a", "b", 1, "", "no links", "at least one link"},
  };
  for (const Bad& bad : table) {
    SCOPED_TRACE(bad.from + " -> " + bad.to);
    std::string text = bad.text;
    const std::size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, bad.from.size(), bad.to);
    const std::string path = folder_.write(bad.text == urdf ? "bad.urdf" : "bad.sdf", text);
    testing::internal::CaptureStderr();
    const std::string message = test::refusal([&] { read_skeleton(path); });
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    const std::string line = bad.line > 0 ? ":" + std::to_string(bad.line) : "";
    const std::string begin =
        path + line + ": " + (bad.key.empty() ? "" : bad.key + ": ") + "found " + bad.found;
    EXPECT_EQ(message.rfind(begin, 0), 0U) << message << "\nshould begin with\n" << begin;
    EXPECT_THAT(message, HasSubstr(bad.expected));
  }
}

}  // namespace
}  // namespace plumbline::model
