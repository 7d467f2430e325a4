// The hopping controller's file.
#include "validation/hopping/hopping_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const char* const kFile = PLUMBLINE_ROOT "/robots/mabel/hopping.yaml";

std::string shipped() {
  std::ifstream in(kFile);
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string with(std::string text, const std::string& old, const std::string& replacement) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), replacement);
}

std::string refusal(const std::string& text) {
  const test::TemporaryFolder folder;
  try {
    read_hopping(folder.write("hopping.yaml", text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// The values printed in sidebar 2.
TEST(HoppingFile, HasThePapersParameters) {
  const controllers::HoppingConfig config = read_hopping(kFile);
  const controllers::HoppingParameters& p = config.parameters;
  EXPECT_DOUBLE_EQ(config.period, 1e-3);
  EXPECT_DOUBLE_EQ(p.delta_LA, 0.524);
  EXPECT_DOUBLE_EQ(p.h_T0, 0.140);
  EXPECT_DOUBLE_EQ(p.h_LS_left, 0.209);
  EXPECT_DOUBLE_EQ(p.delta_LS_minus_left, 0.087);
  EXPECT_DOUBLE_EQ(p.delta_LS_minus_right, 0.227);
  EXPECT_DOUBLE_EQ(p.gamma_LA_to_mLA, -23.53);
  EXPECT_DOUBLE_EQ(p.retract_time, 0.05);
  EXPECT_TRUE(p.event_update);
  EXPECT_DOUBLE_EQ(p.delta_phi_d, -0.12);
}

TEST(HoppingFile, BadFilesAreRefused) {
  EXPECT_THAT(refusal(with(shipped(), "delta_LA:", "delta_LAA:")),
              AllOf(HasSubstr("hopping.yaml"), HasSubstr("delta_LA")));
  EXPECT_THAT(refusal(with(shipped(), "unit: ms", "unit: kg")), HasSubstr("period"));
  EXPECT_THAT(refusal(with(shipped(), "controller: hopping", "controller: walking")), HasSubstr("walking"));
  EXPECT_THAT(refusal(with(shipped(), "leg_angle: joints", "leg_angle: toes")), HasSubstr("joints or motor"));
  EXPECT_THAT(refusal(with(shipped(), "contact_samples: {value: 1,", "contact_samples: {value: 1.5,")),
              AllOf(HasSubstr("contact_samples"), HasSubstr("1.5"), HasSubstr("whole number")));
  EXPECT_THAT(refusal(with(shipped(), "contact_samples: {value: 1,", "contact_samples: {value: 1e300,")),
              HasSubstr("contact_samples"));
  EXPECT_THAT(refusal(with(shipped(), "controller/1", "controller/2")), HasSubstr("controller/1"));
  EXPECT_THAT(refusal(shipped().substr(0, 900)), HasSubstr("hopping.yaml"));
}

// What a file does not state is its base's; what it states it changes.
TEST(HoppingFile, StatesOnlyWhatItChangesOfItsBase) {
  const test::TemporaryFolder folder;
  folder.write("base.yaml", shipped());
  const controllers::HoppingConfig base = read_hopping(folder.path("base.yaml"));
  const controllers::HoppingConfig changed = read_hopping(folder.write(
      "changed.yaml",
      "plumbline: controller/1\nbase: base.yaml\nleft:\n  kp_LA: {value: 1, unit: N m/deg, assumed: "
      "test}\nevent_update:\n  K_T: {value: 0.5, unit: \"1\", assumed: test}\n"));
  EXPECT_NEAR(changed.left.kp_LA, 180.0 / 3.14159265358979, 1e-9);
  EXPECT_EQ(changed.left.kd_LA, base.left.kd_LA);
  EXPECT_EQ(changed.right.kp_LA, base.right.kp_LA);
  EXPECT_EQ(changed.parameters.K_T, 0.5);
  EXPECT_EQ(changed.parameters.delta_phi_d, base.parameters.delta_phi_d);
  EXPECT_EQ(changed.workspace.leg_angle_to, base.workspace.leg_angle_to);
}

TEST(HoppingFile, BadBasesAreRefused) {
  const std::string start = "plumbline: controller/1\nbase: ";
  EXPECT_THAT(refusal(start + "nowhere.yaml\n"),
              AllOf(HasSubstr("nowhere.yaml"), HasSubstr("a controller file")));
  EXPECT_THAT(refusal(start + "hopping.yaml\n"), HasSubstr("leads back to itself"));
  EXPECT_THAT(refusal(start + PLUMBLINE_ROOT "/robots/mabel/mabel.yaml\n"), HasSubstr("controller/1"));
  EXPECT_THAT(
      refusal(start + std::string(kFile) + "\nleft:\n  kp: {value: 1, unit: N m/rad, assumed: test}\n"),
      AllOf(HasSubstr("hopping.yaml:4"), HasSubstr("kp")));
  // What no base states cannot be changed in part.
  const test::TemporaryFolder folder;
  std::string text = shipped();
  const std::size_t from = text.find("event_update:");
  folder.write("without.yaml", text.erase(from, text.find("# Gains") - from));
  const std::string part =
      "plumbline: controller/1\nbase: without.yaml\nevent_update:\n  K_T: {value: 1, unit: \"1\", assumed: "
      "test}\n";
  EXPECT_THROW(read_hopping(folder.write("part.yaml", part)), InputError);
}

TEST(HoppingFile, WrittenGainsAreReadBack) {
  const test::TemporaryFolder folder;
  controllers::HoppingConfig config = read_hopping(kFile);
  config.left = {700.0 / 3.0, 17.0, 15.0, 0.3611};
  config.right = {269.5, 76.0, 6.7, 0.1557};
  config.parameters.K_T = 0.361;
  config.leg_angle_filter.samples = 4;
  config.leg_shape_filter.samples = 3;
  write_gains(folder.path("gains.yaml"), kFile, config, "a test");
  const controllers::HoppingConfig read = read_hopping(folder.path("gains.yaml"));
  EXPECT_EQ(read.left.kp_LA, config.left.kp_LA);
  EXPECT_EQ(read.left.kd_LA, config.left.kd_LA);
  EXPECT_EQ(read.left.kp_mLS, config.left.kp_mLS);
  EXPECT_EQ(read.left.kd_mLS, config.left.kd_mLS);
  EXPECT_EQ(read.right.kd_mLS, config.right.kd_mLS);
  EXPECT_EQ(read.parameters.K_T, config.parameters.K_T);
  EXPECT_EQ(read.leg_angle_filter.samples, 4);
  EXPECT_EQ(read.leg_shape_filter.samples, 3);
  EXPECT_EQ(read.parameters.h_T0, config.parameters.h_T0);
  EXPECT_THROW(write_gains(kFile, kFile, config, "a test"), InputError);
}

}  // namespace
}  // namespace plumbline::validation
