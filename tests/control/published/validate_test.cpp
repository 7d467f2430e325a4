// A hopping robot held against published.yaml, in the small.
#include "validation/control/published/validate.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace plumbline::validation {
namespace {

const Verdict& verdict_of(const GaitValidation& done, const std::string& name) {
  return *std::find_if(done.verdicts.begin(), done.verdicts.end(),
                       [&](const Verdict& verdict) { return verdict.name == name; });
}

TEST(Validate, MeasuresWhatWasRunAndDoesNotPassOnWhatWasNot) {
  ValidateOptions options;
  options.run.integrator.set_tolerance(1e-4);
  options.cycles = 12;
  options.starts = 2;
  options.enough = 15;
  options.draws = 2;
  options.held = options.orbit = false;
  const PublishedRobot robot =
      read_published(PLUMBLINE_ROOT "/robots/mabel/published.yaml", {"hopping", {}, ""});
  const GaitValidation done = validate(robot.gaits.front(), options, [](const std::string&, double) {});
  const PublishedGait& published = robot.gaits.front();
  ASSERT_EQ(done.verdicts.size(), published.quantities.size() + published.curves.size());
  EXPECT_FALSE(verdict_of(done, "orbit with the update of the torso").simulated);
  EXPECT_TRUE(verdict_of(done, "hops with gains tuned on rigid cables").simulated);
  // Twelve hops were asked for: that says nothing about 92, unless it fell.
  EXPECT_EQ(verdict_of(done, "hops in a row").simulated.has_value(), done.run.run.fell);
  const Verdict& travel = verdict_of(done, "travel of a hop");
  ASSERT_TRUE(travel.simulated);
  EXPECT_LT(travel.simulated->mean, -0.05);  // backward
  EXPECT_NEAR(verdict_of(done, "turn of the tower in a hop").simulated->mean, travel.simulated->mean / 2.25,
              1e-12);
  EXPECT_TRUE(verdict_of(done, "leg angle of 1 deg of stretch").holds());
  EXPECT_TRUE(verdict_of(done, "leg shape of 1 deg of stretch").holds());
  ASSERT_EQ(done.shares.size(), 3U);
  EXPECT_EQ(done.shares[0].runs, 2);
  EXPECT_GE(done.not_measured(), 2);
  EXPECT_FALSE(done.holds());
}

}  // namespace
}  // namespace plumbline::validation
