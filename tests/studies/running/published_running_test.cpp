#include "validation/studies/running/published_running.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "simulator/trace/error.h"
#include "validation/studies/running/running_file.h"

namespace plumbline::running_tests {
namespace {

using namespace validation;

const std::string kRobot = PLUMBLINE_ROOT "/robots/thumper/";

const Verdict& named(const GaitValidation& done, const std::string& name) {
  for (const Verdict& verdict : done.verdicts) {
    if (verdict.name == name) {
      return verdict;
    }
  }
  throw std::out_of_range(name);
}

TEST(PublishedRunning, HoldsWhatThePaperSaysOfItsLimits) {
  const GaitValidation done = validate_running(read_published_running(kRobot + "published.yaml"));
  EXPECT_EQ(done.not_measured(), 0);
  for (const char* name : {"stance", "flight", "friction used in stance", "least normal force",
                           "torque at the leg-angle motor", "torque at the leg-shape motor"}) {
    EXPECT_TRUE(named(done, name).holds()) << name << ": " << named(done, name).simulated->mean;
  }
  EXPECT_LT(named(done, "largest multiplier").simulated->mean, 1.0);
}

/// The published file with one text replaced, beside the robot's other files.
std::string refusal(const std::string& from, const std::string& to) {
  std::ifstream in(kRobot + "published.yaml");
  std::stringstream text;
  text << in.rdbuf();
  std::string all = text.str();
  const std::size_t at = all.find(from);
  EXPECT_NE(at, std::string::npos);
  all.replace(at, from.size(), to);
  for (const char* name : {"monopod.yaml", "controllers/running.yaml", "curves/"}) {
    for (std::size_t i = 0; (i = all.find(std::string(": ") + name, i)) != std::string::npos; i += 2) {
      all.insert(i + 2, kRobot);
    }
  }
  const std::string path = testing::TempDir() + "published_running.yaml";
  std::ofstream(path) << all;
  try {
    read_published_running(path);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(PublishedRunning, RefusesInOneLine) {
  EXPECT_NE(refusal("measure: stance", "measure: stanze").find("did you mean stance"), std::string::npos);
  EXPECT_NE(refusal("of: pitch", "of: knee").find("pitch, motor, ahead, shape"), std::string::npos);
  EXPECT_NE(refusal("unit: s, source", "unit: m, source").find("unit"), std::string::npos);
}

TEST(RunningDesign, IsReadWithItsCurves) {
  const RunningDesignFile file = read_running_design(kRobot + "running_design.yaml");
  EXPECT_EQ(file.design.free.size(), 14u);
  EXPECT_NEAR(file.design.stance, 0.2009, 1e-12);
  EXPECT_NEAR(file.design.torso.tolerance, 1e-3, 1e-12);
  EXPECT_NEAR(file.design.torso.at(0.0), 0.0651, 1e-4);
  // Poses are solved for: the centre of mass is where the figure shows it.
  const monopod::State state = state_at(file.design.constants, file.design.touchdown);
  const monopod::Dynamics d = monopod::dynamics(file.design.constants, state);
  EXPECT_NEAR(d.com[0] - d.toe[0], -0.10195, 1e-9);
}

}  // namespace
}  // namespace plumbline::running_tests
