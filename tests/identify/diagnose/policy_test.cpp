// The constants of the policy are listed, and documented as they are.
#include "validation/identify/diagnose/policy.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace plumbline::validation {
namespace {

std::string text_of(const std::string& file_of_project) {
  std::ifstream file(PLUMBLINE_ROOT + file_of_project);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

TEST(Policy, EveryConstantStandsInTheDocumentsWithItsValue) {
  const std::string page = text_of("/docs/method-constants.md");
  for (const PolicyConstant& constant : policy_constants()) {
    const std::size_t row = page.find(fmt::format("| `{}` | ", constant.name));
    ASSERT_NE(row, std::string::npos) << constant.name;
    const std::size_t value = page.find("| ", row + 2) + 2;
    EXPECT_DOUBLE_EQ(std::stod(page.substr(value)), constant.value(Policy{})) << constant.name;
  }
}

// So that no constant is left out of the sweep and of the page: every number of the struct is in the list.
TEST(Policy, TheListHasAllNumbersInTheirOrder) {
  const std::string text = text_of("/validation/identify/diagnose/policy.h");
  const std::size_t begin = text.find("struct Policy {");
  const std::string body = text.substr(begin, text.find("};", begin) - begin);
  const std::regex number("\\n  (?:double|int) (\\w+) = ");
  std::vector<std::string> names, listed;
  for (std::sregex_iterator one(body.begin(), body.end(), number), end; one != end; ++one) {
    names.push_back((*one)[1]);
  }
  names.erase(std::remove(names.begin(), names.end(), "resamples"), names.end());
  for (const PolicyConstant& constant : policy_constants()) {
    listed.push_back(constant.name);
  }
  EXPECT_EQ(names, listed);
}

Policy twice(const std::string& name) {
  const std::vector<PolicyConstant>& all = policy_constants();
  const auto constant =
      std::find_if(all.begin(), all.end(), [&](const PolicyConstant& one) { return one.name == name; });
  Policy policy;
  constant->scale(policy, 2.0);
  return policy;
}

TEST(Policy, ErrorsAreScaledFromTheFloor) {
  EXPECT_DOUBLE_EQ(twice("finished").finished, 1.4);
  EXPECT_EQ(twice("refits").refits, 16);
  EXPECT_DOUBLE_EQ(twice("material").material, 0.1);
}

}  // namespace
}  // namespace plumbline::validation
