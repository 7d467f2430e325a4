// MJCF files in several parts: includes, repeated sections, and meshes that give inertias.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/model/mjcf_file.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/skeleton_export.h"
#include "simulator/model/stated_drives.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::HasSubstr;

constexpr const char* kScene = R"(<mujoco model="scene">
  <include file="parts/robot.xml"/>
  <default><geom density="500"/></default>
  <worldbody><geom type="plane" size="1 1 1"/></worldbody>
</mujoco>
)";

constexpr const char* kRobot = R"(<mujoco>
  <compiler angle="radian"/>
  <option gravity="0 0 -3"/>
  <default><joint damping="0.7"/></default>
  <worldbody>
    <body name="bar">
      <joint name="hinge" axis="0 1 0"/>
      <geom type="box" size="0.1 0.2 0.3" pos="0 0 -0.3"/>
      <include file="parts/tip.xml"/>
    </body>
  </worldbody>
  <actuator><motor joint="hinge" ctrlrange="-4 4"/></actuator>
</mujoco>
)";

constexpr const char* kTip = R"(<mujocoinclude>
  <body name="tip" pos="0 0 -0.6">
    <inertial pos="0 0 0" mass="1" diaginertia="0.01 0.01 0.01"/>
  </body>
</mujocoinclude>
)";

class MjcfParts : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("parts/robot.xml", kRobot);
    folder_.write("parts/tip.xml", kTip);
  }
  std::string scene() const { return folder_.write("scene.xml", kScene); }
  test::TemporaryFolder folder_;
};

TEST_F(MjcfParts, IncludedFilesStandInTheirPlace) {
  const Skeleton skeleton = read_mjcf(scene());
  ASSERT_EQ(skeleton.bodies.size(), 2U);
  EXPECT_EQ(skeleton.bodies[1].name, "tip");
  EXPECT_EQ(skeleton.joints[1].parent, 0);
  EXPECT_EQ(skeleton.gravity.z(), -3.0);
  EXPECT_EQ(skeleton.joints[0].damping, 0.7);                  // of the robot's defaults
  EXPECT_NEAR(skeleton.bodies[0].mass, 500.0 * 0.048, 1e-12);  // density of the scene's
  const MjcfDrives drives = read_mjcf_drives(scene());
  ASSERT_EQ(drives.actuators.size(), 1U);
  EXPECT_EQ(drives.actuators[0].limit, 4.0);
}

TEST_F(MjcfParts, AnErrorIsWhereItStands) {
  std::string tip = kTip;
  tip.replace(tip.find("mass=\"1\""), 8, "mass=\"-1\"");
  folder_.write("parts/tip.xml", tip);
  EXPECT_THAT(test::refusal([&] { read_mjcf(scene()); }),
              HasSubstr("parts/tip.xml:3: inertial: found a mass of -1 kg"));
  folder_.write("parts/tip.xml", "<mujocoinclude>\n<body>");
  EXPECT_THAT(test::refusal([&] { read_mjcf(scene()); }),
              HasSubstr("parts/tip.xml:2: found text that is no XML"));
}

TEST_F(MjcfParts, AFileThatIsNotThereOrCameBeforeIsRefused) {
  std::string robot = kRobot;
  robot.replace(robot.find("tip.xml"), 7, "top.xml");
  folder_.write("parts/robot.xml", robot);
  EXPECT_THAT(test::refusal([&] { read_mjcf(scene()); }),
              HasSubstr("parts/robot.xml:9: include: found no file \"parts/top.xml\""));
  robot.replace(robot.find("top.xml"), 7, "robot.xml");
  folder_.write("parts/robot.xml", robot);
  EXPECT_THAT(test::refusal([&] { read_mjcf(scene()); }), HasSubstr("a second time"));
}

TEST_F(MjcfParts, ElementsThatMakeBodiesAreNotPassedOver) {
  std::string tip = kTip;
  tip.insert(tip.find("<body"), "<frame pos=\"0 0 1\"><body/></frame>");
  folder_.write("parts/tip.xml", tip);
  EXPECT_THAT(test::refusal([&] { read_mjcf(scene()); }),
              HasSubstr("tip.xml:2: frame: found <frame>, which makes bodies"));
}

/// A box of half axes 0.1, 0.2, 0.3 m in units of 1 cm, all its faces outward.
constexpr const char* kBox =
    "v -10 -20 -30\nv 10 -20 -30\nv 10 20 -30\nv -10 20 -30\nv -10 -20 30\nv 10 -20 30\nv 10 20 30\nv -10 20 "
    "30\n"
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

TEST_F(MjcfParts, AClosedMeshGivesTheInertiaThatItsSolidHas) {
  folder_.write("meshes/box.obj", kBox);
  const std::string begin =
      "<mujoco><compiler meshdir=\"meshes\"/><asset><mesh file=\"box.obj\" scale=\"0.01 0.01 0.01\"/></asset>"
      "<worldbody><body><joint/><geom mass=\"3\" pos=\"0.1 0 0.2\" euler=\"20 30 40\" type=";
  const std::string end = "/></body></worldbody></mujoco>";
  const Skeleton by_mesh = read_mjcf(folder_.write("mesh.xml", begin + "\"mesh\" mesh=\"box\"" + end));
  const Skeleton by_box = read_mjcf(folder_.write("box.xml", begin + "\"box\" size=\"0.1 0.2 0.3\"" + end));
  EXPECT_EQ(by_mesh.bodies[0].mass, 3.0);
  EXPECT_LT((by_mesh.bodies[0].com - by_box.bodies[0].com).norm(), 1e-12);
  EXPECT_LT((by_mesh.bodies[0].inertia - by_box.bodies[0].inertia).norm(), 1e-12);

  const std::string open = std::string(kBox).substr(0, std::string(kBox).find("f 4 1"));
  folder_.write("meshes/box.obj", open);
  EXPECT_THAT(test::refusal([&] { read_mjcf(folder_.path("mesh.xml")); }), HasSubstr("is not closed"));
  EXPECT_THAT(
      test::refusal([&] { read_mjcf(folder_.write("none.xml", begin + "\"mesh\" mesh=\"cone\"" + end)); }),
      HasSubstr("mesh \"cone\""));
}

}  // namespace
}  // namespace plumbline::model
