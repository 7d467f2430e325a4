// Shapes of links from SDFormat and URDF.
#include "simulator/model/visual.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/model/robot_file.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

const char* const kSdf = R"(<?xml version="1.0"?>
<sdf version="1.9"><model name="m">
  <link name="base"/>
  <link name="arm">
    <inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial>
    <visual name="box"><pose>0.1 0.2 0.3 0 0 1.5707963267948966</pose>
      <geometry><box><size>1 2 3</size></box></geometry>
      <material><diffuse>0.25 0.5 0.75 1</diffuse></material></visual>
    <visual name="rod"><geometry><cylinder><radius>0.1</radius><length>0.4</length></cylinder></geometry></visual>
    <visual name="ball"><geometry><sphere><radius>0.2</radius></sphere></geometry></visual>
    <visual name="egg"><geometry><ellipsoid><radii>0.1 0.2 0.3</radii></ellipsoid></geometry></visual>
    <visual name="hull"><geometry><mesh><uri>model://robot/meshes/a.stl</uri><scale>2 2 2</scale></mesh></geometry></visual>
    <visual name="ground"><geometry><plane><normal>0 0 1</normal><size>1 1</size></plane></geometry></visual>
  </link>
  <joint name="j" type="revolute"><parent>base</parent><child>arm</child><axis><xyz>0 1 0</xyz></axis></joint>
</model></sdf>
)";

TEST(Visuals, OfAnSdf) {
  const test::TemporaryFolder folder;
  const std::string mesh = folder.write("robot/meshes/a.stl", "");
  const Visuals visuals = read_visuals(folder.write("robot/sdf/m.sdf", kSdf));
  const std::vector<Visual>& arm = visuals.of_link.at("arm");
  ASSERT_EQ(arm.size(), 5U);
  EXPECT_EQ(std::get<BoxShape>(arm[0].shape).size, Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((arm[0].X_BV * Eigen::Vector3d(1, 0, 0) - Eigen::Vector3d(0.1, 1.2, 0.3)).norm(), 1e-12);
  EXPECT_LT((*arm[0].color - Eigen::Vector3d(0.25, 0.5, 0.75)).norm(), 1e-6);
  EXPECT_EQ(std::get<CylinderShape>(arm[1].shape).length, 0.4);
  EXPECT_FALSE(arm[1].color);
  EXPECT_EQ(std::get<SphereShape>(arm[2].shape).radius, 0.2);
  EXPECT_EQ(std::get<EllipsoidShape>(arm[3].shape).radii.z(), 0.3);
  EXPECT_EQ(std::get<MeshShape>(arm[4].shape).file,
            mesh);  // beside the skeleton's folder, by the package's name
  EXPECT_EQ(std::get<MeshShape>(arm[4].shape).scale.x(), 2.0);
  ASSERT_EQ(visuals.left_out.size(), 1U);
  EXPECT_THAT(visuals.left_out[0],
              testing::HasSubstr("m.sdf:4: arm ground: found a shape that is not drawn"));
}

TEST(Visuals, OfAUrdfAndThePhysicsDoesNotSeeThem) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("r.urdf", R"(<?xml version="1.0"?>
<robot name="r">
  <material name="blue"><color rgba="0 0 1 1"/></material>
  <link name="world"/>
  <link name="arm">
    <inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
    <visual><origin xyz="0 0 -0.3" rpy="0 0 0"/><geometry><box size="0.1 0.2 0.3"/></geometry>
      <material name="blue"/></visual>
    <visual><geometry><mesh filename="package://r/none.dae" scale="0.001 0.001 0.001"/></geometry></visual>
  </link>
  <joint name="j" type="continuous"><parent link="world"/><child link="arm"/><axis xyz="0 1 0"/></joint>
</robot>
)");
  const Visuals visuals = read_visuals(file);
  const std::vector<Visual>& arm = visuals.of_link.at("arm");
  ASSERT_EQ(arm.size(), 2U);
  EXPECT_EQ(std::get<BoxShape>(arm[0].shape).size, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_NEAR(arm[0].X_BV.translation().z(), -0.3, 1e-12);
  EXPECT_LT((*arm[0].color - Eigen::Vector3d(0, 0, 1)).norm(), 1e-6);
  EXPECT_NEAR(std::get<MeshShape>(arm[1].shape).scale.y(), 0.001, 1e-15);
  EXPECT_THAT(std::get<MeshShape>(arm[1].shape).file, testing::EndsWith("r/none.dae"));
  EXPECT_EQ(read_skeleton(file).bodies.back().mass, 1.0);
}

TEST(Visuals, ABrokenFileIsRefusedInOneLine) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("m.sdf", "<sdf><model");
  EXPECT_THAT(test::refusal([&] { read_visuals(file); }), testing::HasSubstr("no XML"));
}

}  // namespace
}  // namespace plumbline::model
