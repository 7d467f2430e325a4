// The hopping robot held against published.yaml, in the small, and the orbit of its gait.
#include "validation/hopping/validate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/hopping/hopping_file.h"

namespace plumbline::validation {
namespace {

const std::string kFolder = PLUMBLINE_ROOT "/robots/mabel/";

HopOptions coarse() {
  HopOptions options;
  options.integrator.relative_tolerance = 1e-4;
  options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-6);
  return options;
}

ValidateInputs mabel() {
  ValidateInputs inputs;
  inputs.model = model::read_model(kFolder + "mabel_planar.yaml", model::known_effects());
  inputs.controller = read_hopping(kFolder + "hopping.yaml");
  inputs.published = read_published(kFolder + "published.yaml").quantities;
  return inputs;
}

const PublishedVerdict& verdict_of(const Validation& done, const std::string& measure) {
  return *std::find_if(done.verdicts.begin(), done.verdicts.end(), [&](const PublishedVerdict& verdict) {
    return verdict.published.measure->name == measure;
  });
}

TEST(Validate, MeasuresWhatWasRunAndSaysWhatWasNot) {
  ValidateOptions options;
  options.run = coarse();
  options.hops = 12;
  options.starts = 2;
  options.enough = 15;
  options.draws = 2;
  options.without = options.orbit = false;
  const ValidateInputs inputs = mabel();
  const Validation done = validate(inputs, options, [](const std::string&, double) {});
  ASSERT_EQ(done.verdicts.size(), inputs.published.size());
  EXPECT_FALSE(verdict_of(done, "growth").simulated);
  EXPECT_FALSE(verdict_of(done, "hops_tuned_rigid").simulated);
  // Twelve hops were asked for: that says nothing about 92, unless it fell.
  EXPECT_EQ(verdict_of(done, "hops").simulated.has_value(), done.run.fell);
  const PublishedVerdict& travel = verdict_of(done, "travel");
  ASSERT_TRUE(travel.simulated);
  EXPECT_LT(travel.simulated->mean, -0.05);  // backward
  EXPECT_NEAR(verdict_of(done, "tower_turn").simulated->mean, travel.simulated->mean / 2.25, 1e-12);
  EXPECT_TRUE(verdict_of(done, "joint_angle_of_stretch_LA").holds());
  EXPECT_TRUE(verdict_of(done, "joint_angle_of_stretch_LS").holds());
  ASSERT_EQ(done.shares.size(), 2U);
  EXPECT_EQ(done.shares[0].runs, 2);
  EXPECT_EQ(done.shares[1].runs, 2);
  const bool all = std::all_of(done.verdicts.begin(), done.verdicts.end(),
                               [](const PublishedVerdict& v) { return !v.simulated || v.holds(); });
  EXPECT_EQ(done.holds(), all);
}

}  // namespace
}  // namespace plumbline::validation
