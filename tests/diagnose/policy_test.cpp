// The constants of the policy are listed, and documented as they are.
#include "validation/diagnose/policy.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <fstream>
#include <sstream>

namespace plumbline::validation {
namespace {

std::string constants_page() {
  std::ifstream file(PLUMBLINE_ROOT "/docs/method-constants.md");
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Policy, EveryConstantStandsInTheDocumentsWithItsValue) {
  const std::string page = constants_page();
  for (const PolicyConstant& constant : policy_constants()) {
    const std::size_t row = page.find(fmt::format("| `{}` | ", constant.name));
    ASSERT_NE(row, std::string::npos) << constant.name;
    const std::size_t value = page.find("| ", row + 2) + 2;
    EXPECT_DOUBLE_EQ(std::stod(page.substr(value)), constant.value(Policy{})) << constant.name;
  }
}

// So that no constant is left out of the sweep: what the struct holds beside the list is known.
TEST(Policy, TheListHasAllNumbers) {
  std::size_t bytes = 0;
  for (const PolicyConstant& constant : policy_constants()) {
    bytes += std::holds_alternative<int Policy::*>(constant.member) ? sizeof(int) : sizeof(double);
  }
  struct Rest {
    double aligned;
    bool dear;
    std::size_t windows;
    int resamples;
    unsigned seed;
  };
  const std::size_t padding = sizeof(double);
  EXPECT_LE(sizeof(Policy) - bytes, sizeof(Rest) + padding);
}

TEST(Policy, ErrorsAreScaledFromTheFloor) {
  for (const PolicyConstant& constant : policy_constants()) {
    Policy policy;
    constant.scale(policy, 2.0);
    if (constant.name == "finished") {
      EXPECT_DOUBLE_EQ(policy.finished, 1.4);
    } else if (constant.name == "refits") {
      EXPECT_EQ(policy.refits, 16);
    } else if (constant.name == "material") {
      EXPECT_DOUBLE_EQ(policy.material, 0.1);
    }
  }
}

}  // namespace
}  // namespace plumbline::validation
