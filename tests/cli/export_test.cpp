// `plumbline export`: the identified model as a file that other simulators read.
#include <gmock/gmock.h>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class ExportCommand : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    write(
        "arm.urdf",
        "<robot name=\"arm\"><link name=\"base\"/>\n"
        "<link name=\"bar\"><inertial><origin xyz=\"0 0 -0.25\"/><mass value=\"2\"/> <!-- a bar -->\n"
        "<inertia ixx=\"0.05\" iyy=\"0.05\" izz=\"0.001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n"
        "<joint name=\"swing\" type=\"continuous\"><parent link=\"base\"/><child link=\"bar\"/>\n"
        "<origin xyz=\"0 0 0\"/><axis xyz=\"0 1 0\"/></joint></robot>\n");
    succeed({"new-model", "arm.urdf", "--out", "model.yaml"});
    succeed({"add", "viscous", "--at", "swing", "--set", "damping=0.7", "--model", "model.yaml", "-o",
             "one.yaml"});
    succeed(
        {"add", "added_mass", "--at", "bar", "--set", "mass=0.5", "--model", "one.yaml", "-o", "two.yaml"});
    succeed({"add", "cable_stretch", "--at", "swing", "--set", "stiffness=100", "--model", "two.yaml", "-o",
             "three.yaml"});
  }
};

TEST_F(ExportCommand, WritesWhatAddedEffectsSayAndListsTheRest) {
  const Outcome said = succeed({"export", "three.yaml", "-o", "out.urdf", "--json", "out.json"});
  const std::string out = read("out.urdf");
  EXPECT_THAT(out, HasSubstr("<mass value=\"2.5\"/> <!-- a bar -->"));
  EXPECT_THAT(out, HasSubstr("damping=\"0.7\""));
  EXPECT_THAT(out, HasSubstr("ixx=\"0.0625\""));
  EXPECT_THAT(said.out, HasSubstr("- The effect cable_stretch at swing"));
  const json made = read_json("out.json");
  EXPECT_EQ(made["format"], "URDF");
  EXPECT_EQ(made["changed"].at(0)["what"], "mass");
}

TEST_F(ExportCommand, WhatItWroteIsTheSkeletonOfANewModel) {
  succeed({"export", "two.yaml", "-o", "out.xml"});
  succeed({"new-model", "out.xml", "--out", "again.yaml"});
  EXPECT_THAT(read("again.yaml"), HasSubstr("damping: {value: 0.7"));
}

TEST_F(ExportCommand, RefusesInOneLineAndWritesNothing) {
  const auto before = snapshot();
  const auto refusal = [&](const std::string& out) {
    const Outcome refused = plumbline({"export", "two.yaml", "-o", out});
    EXPECT_EQ(refused.status, 2);
    EXPECT_EQ(refused.out, "");
    return refused.err;
  };
  EXPECT_THAT(refusal("out.sdf"), HasSubstr("SDFormat wished of a skeleton in URDF"));
  EXPECT_THAT(refusal("arm.urdf"),
              HasSubstr("arm.urdf: found the name of a file that the model is read from"));
  EXPECT_THAT(refusal("out.stl"), HasSubstr("expected one that ends in .urdf"));
  EXPECT_TRUE(changed_since(before).empty());
}

}  // namespace
}  // namespace plumbline::test
