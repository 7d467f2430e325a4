// A controller's file: what it says, what stands on what, and one line for each mistake.
#include "simulator/run/controller_setup.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/wired_controller.h"
#include "tests/run/files.h"

namespace plumbline::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kHold = R"(plumbline: controller/2
library: hold_position
period: {value: 2, unit: ms, source: "test"}
constants:
  position_wanted: {value: 90, unit: deg, assumed: "test"}
  kp: {value: 2, unit: N m/rad, assumed: "test"}
  kd: {value: 0.05, unit: N m s/rad, assumed: "test"}
inputs:
  position: mLA
outputs:
  torque: mLA
)";

std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string error_of(const std::string& text) {
  const Folder folder;
  const std::string file = folder.write("c.yaml", text);
  return message_of<InputError>([&] {
    const ControllerSetup setup = read_controller(file);
    const WiredController wired(model::read_model(robots("mabel/leg_bench.yaml"), model::known_effects()),
                                setup);
  });
}

TEST(ControllerSetup, NumbersComeOutInSi) {
  const Folder folder;
  const ControllerSetup setup = read_controller(folder.write("c.yaml", kHold));
  EXPECT_EQ(setup.period, 0.002);
  EXPECT_NEAR(setup.constant("position_wanted"), 1.5707963267948966, 1e-15);
  EXPECT_EQ(setup.constant("kd"), 0.05);
  EXPECT_TRUE(setup.quantities[0].assumed);
  EXPECT_EQ(error_of(kHold), "");
}

TEST(ControllerSetup, AFileOnABaseStatesWhatItChanges) {
  const Folder folder;
  folder.write("base.yaml", kHold);
  const ControllerSetup setup = read_controller(folder.write("c.yaml", R"(plumbline: controller/2
base: base.yaml
constants:
  kp: {value: 3, unit: N m/rad, assumed: "test"}
)"));
  EXPECT_EQ(setup.constant("kp"), 3.0);
  EXPECT_EQ(setup.constant("kd"), 0.05);
}

TEST(ControllerSetup, WhatASearchFoundIsReadBack) {
  const Folder folder;
  const std::string base = folder.write("base.yaml", kHold);
  ControllerSetup setup = read_controller(base);
  setup.set("kp", 4.125);
  const std::string found = folder.write("found.yaml", "");
  write_constants(found, base, setup, {"kp"}, "a note", "found by search");
  EXPECT_EQ(read_controller(found).constant("kp"), 4.125);
}

TEST(ControllerSetup, EveryMistakeIsOneLine) {
  EXPECT_THAT(
      error_of(with(kHold, "library: hold_position", "library: no_such")),
      AllOf(HasSubstr("c.yaml:2: library: found \"no_such\""), HasSubstr("not among the built controllers")));
  EXPECT_THAT(error_of(with(kHold, "library: hold_position", "library: ./c.yaml")),
              HasSubstr("does not load"));
  EXPECT_THAT(error_of(with(kHold, "  kd: {value: 0.05, unit: N m s/rad, assumed: \"test\"}\n", "")),
              HasSubstr("constants: found no \"kd\", expected it, which controller hold_position needs"));
  EXPECT_THAT(error_of(with(kHold, "  kd:", "  kdd:")),
              HasSubstr("no such port of controller hold_position"));
  EXPECT_THAT(error_of(with(kHold, "unit: N m/rad", "unit: m")), HasSubstr("a unit like \"N m/rad\""));
  EXPECT_THAT(error_of(with(kHold, "value: 2, unit: N m/rad", "value: -2, unit: N m/rad")), HasSubstr("kp"));
  EXPECT_THAT(error_of(with(kHold, "  position: mLA\n", "")),
              HasSubstr("inputs: found nothing, expected a map"));
  EXPECT_THAT(error_of(with(kHold, "position: mLA", "position: mLX")),
              AllOf(HasSubstr("inputs: position: found \"mLX\""), HasSubstr("did you mean")));
  EXPECT_THAT(error_of(with(kHold, "torque: mLA", "torque: knee")), HasSubstr("expected a motor of"));
  EXPECT_THAT(error_of(with(kHold, "position: mLA",
                            "position: {sensor: mLA, divide_by: {value: 2, unit: m, source: \"test\"}}")),
              HasSubstr("a signal in"));
  EXPECT_THAT(error_of(with(kHold, "position: mLA", "position: {value: 1, unit: rad, source: \"test\"}")),
              HasSubstr("the port takes counts"));
}

}  // namespace
}  // namespace plumbline::run
