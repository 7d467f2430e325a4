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

}  // namespace
}  // namespace plumbline::validation
