#include "simulator/model/limbs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace plumbline::model {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A link on a revolute joint of its own name; parent -1: the world.
void add_link(Model& model, const std::string& name, int parent) {
  Body body;
  body.name = name;
  model.skeleton.bodies.push_back(body);
  Joint joint;
  joint.name = name + "_joint";
  joint.type = JointType::revolute;
  joint.parent = parent;
  joint.child = static_cast<int>(model.skeleton.bodies.size()) - 1;
  model.skeleton.joints.push_back(joint);
}

void add_motor(Model& model, const std::string& name, const std::string& moves) {
  Motor motor;
  motor.name = name;
  model.motors.push_back(motor);
  Ratio ratio;
  ratio.name = moves;
  ratio.motor = name;
  ratio.to = {{moves, 1.0}};
  ratio.ratios.resize(1);
  model.ratios.push_back(ratio);
}

/// A trunk with a leg of two motors, a leg whose second motor sits behind a coordinate and a pulley, and a
/// tail with one.
Model animal() {
  Model model;
  add_link(model, "trunk", -1);
  add_link(model, "left_thigh", 0);
  add_link(model, "left_shin", 1);
  add_link(model, "right_thigh", 0);
  add_link(model, "right_shin", 3);
  add_link(model, "tail", 0);
  add_motor(model, "left_hip", "left_thigh_joint");
  add_motor(model, "left_knee", "left_shin_joint");
  add_motor(model, "right_hip", "right_thigh_joint");
  model.coordinates.push_back({"right_leg", true, {{"right_thigh_joint", 0.5}, {"right_shin_joint", 1.0}}});
  model.pulleys.push_back({"right_pulley", {}});
  add_motor(model, "right_knee", "right_pulley");
  model.ratios.push_back({"right_leg", "right_pulley", {{"right_leg", 2.0}}, {Quantity{}}});
  add_motor(model, "tail_motor", "tail_joint");
  return model;
}

TEST(Limbs, AreTheWholeRobotAndWhatAForkCarries) {
  EXPECT_THAT(limbs(animal()), ElementsAre("world", "left_thigh", "right_thigh"));
}

TEST(Limbs, CarryTheMotorsThatMoveNothingElse) {
  const Model model = animal();
  std::string on_right, on_all;
  for (const Motor& motor : model.motors) {
    on_right += is_on_limb(model, "right_thigh", motor) ? motor.name + " " : "";
    on_all += is_on_limb(model, "world", motor) ? "x" : "-";
  }
  EXPECT_EQ(on_right, "right_hip right_knee ");
  EXPECT_EQ(on_all, "xxxxx");
}

TEST(Limbs, OfAChainAreTheWholeAlone) {
  Model model;
  add_link(model, "upper", -1);
  add_link(model, "lower", 0);
  add_motor(model, "shoulder", "upper_joint");
  EXPECT_THAT(limbs(model), IsEmpty());  // one motor's delay is its own
  add_motor(model, "elbow", "lower_joint");
  EXPECT_THAT(limbs(model), ElementsAre("world"));
}

TEST(Limbs, AMotorThatMovesTwoLimbsIsOnNeither) {
  Model model = animal();
  model.coordinates.push_back({"both", true, {{"left_thigh_joint", 0.5}, {"right_thigh_joint", 0.5}}});
  add_motor(model, "waist", "both");
  EXPECT_FALSE(is_on_limb(model, "left_thigh", model.motors.back()));
  EXPECT_TRUE(is_on_limb(model, "world", model.motors.back()));
}

}  // namespace
}  // namespace plumbline::model
