// Deviations held against the cost: of values that slopes tell, and of a law in a curved valley.
#include "validation/identify/predict/profile.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/fit/fit.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr double kInterval = 1.96;

struct Fitted {
  model::Model model;
  std::vector<FreeParameter> parameters;
  Profiled held;
  Estimate before;
};

Fitted held(const std::string& effect, const Data& data) {
  Fitted one;
  one.model = bench();
  one.model.effects.push_back(parse_effect(effect, one.model, effects::Catalogue::all()));
  one.parameters = matching(free_parameters(one.model), {effect.substr(0, effect.find('@')) + "@*"});
  PredictorPool pool(one.model, data);
  one.before = gauss_newton(pool, one.parameters, values_of(one.model, one.parameters), {}, {12, 1e-6});
  std::vector<int> all;
  for (std::size_t p = 0; p < one.parameters.size(); ++p) {
    all.push_back(static_cast<int>(p));
  }
  one.held = profile(pool, one.parameters, one.before, all);
  return one;
}

/// In the order of the law's fitted parameters.
void expect_inside(const std::vector<double>& truth, const Fitted& fitted) {
  ASSERT_EQ(truth.size(), fitted.parameters.size());
  for (std::size_t p = 0; p < truth.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    EXPECT_NEAR(fitted.held.estimate.theta[i], truth[p], kInterval * fitted.held.held.deviations[i])
        << fitted.parameters[p].label;
  }
}

// The cost is a parabola in the torque of a dry friction, to all that matters.
TEST(Profile, LeavesWhatSlopesTell) {
  const Data data = bench_twins({"coulomb@mLA:level=0.005,smoothing_speed=0.03"}).thinned(6);
  const Fitted found = held("coulomb@mLA:level=0.004,smoothing_speed=0.03", data);
  EXPECT_TRUE(found.held.held.deviations.isApprox(found.held.slopes.deviations, 0.02));
  EXPECT_EQ(found.held.estimate.theta, found.before.theta);
}

const char* const kSpring =
    "unilateral_spring@thigh:stiffness=0.6,preload=0.025,rest=0.29,side=-1,smoothing_length=0.005";

// Nothing tells a smoothing length of nanoradians from none; rest and preload would seem as well known as if
// it were known, too.
TEST(Profile, LiftsAValueThatHasCollapsed) {
  const Data data = bench_twins({kSpring}).thinned(8);
  const Fitted found = held(
      "unilateral_spring@thigh:stiffness=0.6,preload=0.03,rest=0.285,side=-1,smoothing_length=1e-8", data);
  expect_inside({0.6, 0.025, 0.29, 0.005}, found);
  EXPECT_LT(found.held.held.deviations[2], 0.02) << "rad: the rest is told all the same";
}

// A rest a little beside the true one is a minimum of its own.
TEST(Profile, GoesOnFromWhatIsBetter) {
  const Data data = bench_twins({kSpring}).thinned(8);
  const Fitted found = held(
      "unilateral_spring@thigh:stiffness=0.57,preload=0.05,rest=0.267,side=-1,smoothing_length=1e-8", data);
  EXPECT_LT(found.held.estimate.cost, found.before.cost - 5.0);
  expect_inside({0.6, 0.025, 0.29, 0.005}, found);
}

struct Start {
  double rest, smoothing_length;
};

class FitOfARest : public testing::TestWithParam<Start> {};

// `plumbline fit` of a spring whose rest was taken for 23 mrad less than it is, and of one that was taken to
// begin more sharply than the samples show.
TEST_P(FitOfARest, EndsAtTheTruthWithinItsIntervals) {
  const Data data = bench_twins({kSpring}).thinned(40);
  model::Model model = bench();
  const std::string start =
      fmt::format("unilateral_spring@thigh:stiffness=0.57,preload=0.05,rest={},side=-1,smoothing_length={}",
                  GetParam().rest, GetParam().smoothing_length);
  model.effects.push_back(parse_effect(start, model, effects::Catalogue::all()));
  const Fit found = fit(model, data, matching(free_parameters(model), {"unilateral_spring@*"}), {}, silent);
  const std::vector<double> truth{0.6, 0.025, 0.29, 0.005};
  ASSERT_EQ(found.parameters.size(), truth.size());
  for (std::size_t p = 0; p < truth.size(); ++p) {
    EXPECT_LE(found.parameters[p].lower, truth[p]) << found.parameters[p].label;
    EXPECT_GE(found.parameters[p].upper, truth[p]) << found.parameters[p].label;
  }
  EXPECT_NEAR(found.parameters[2].after, 0.29, 0.002) << "rad";
  EXPECT_LT(found.parameters[2].upper - found.parameters[2].lower, 0.015) << "rad";
}

INSTANTIATE_TEST_SUITE_P(Profile, FitOfARest, testing::Values(Start{0.267, 0.002}, Start{0.295, 1e-5}));

}  // namespace
}  // namespace plumbline::validation
