#include "validation/identify/standard/standard_windows.h"

#include <gtest/gtest.h>

#include "tests/identify/standard/double_pendulum.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/diagnose/candidates.h"

namespace plumbline::validation {
namespace {

using pendulums::Truth;

double value_of(const WindowsFit& fit, const std::string& label) {
  for (std::size_t p = 0; p < fit.stage.parameters.size(); ++p) {
    if (fit.stage.parameters[p].label == label) {
      return fit.stage.estimate.theta[static_cast<Eigen::Index>(p)];
    }
  }
  ADD_FAILURE() << "no value " << label;
  return 0.0;
}

// Friction at the elbow and a heavier link, torques from Lagrange's equations by hand: all values at once,
// without any torque being differentiated.
TEST(StandardWindows, ExplainTwoErrorsAtOnce) {
  Truth truth;
  truth.viscous = 0.05;
  truth.lower_mass = 0.7;
  const Data data = pendulums::data(truth);
  const std::optional<WindowsFit> fit =
      standard_by_windows(pendulums::stated(), Freed::all, nullptr, data, 12, pendulums::silent);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(value_of(*fit, "viscous@elbow_motor:damping"), truth.viscous, 0.1 * truth.viscous);
  const Scores before = compare(pendulums::stated(), data).scores;
  EXPECT_LT(fit->scores.train, 0.05 * before.train);
  EXPECT_LT(fit->scores.held_out, 0.1 * before.held_out);
}

// What it says of its model is what `compare` says of it.
TEST(StandardWindows, ReportWhatCompareFinds) {
  Truth truth;
  truth.viscous = 0.03;
  const Data data = pendulums::data(truth);
  const std::optional<WindowsFit> fit =
      standard_by_windows(pendulums::stated(), Freed::all, nullptr, data, 8, pendulums::silent);
  ASSERT_TRUE(fit);
  const Scores again = compare(fitted_model(fit->stage), data).scores;
  EXPECT_NEAR(fit->scores.train, again.train, 0.01 * again.train);
  EXPECT_NEAR(fit->scores.held_out, again.held_out, 0.01 * again.held_out);
}

// The load is a mass, which the drives alone cannot be; and the answer rests on masses, not on friction.
TEST(StandardWindows, RestOnTheKindThatIsWrong) {
  Truth truth;
  truth.lower_mass = 0.8;
  const Data data = pendulums::data(truth);
  const model::Model stated = pendulums::stated();
  const std::optional<WindowsFit> all =
      standard_by_windows(stated, Freed::all, nullptr, data, 8, pendulums::silent);
  const std::optional<WindowsFit> drives =
      standard_by_windows(stated, Freed::drives, nullptr, data, 8, pendulums::silent);
  ASSERT_TRUE(all && drives);
  EXPECT_EQ(drives->values, 10);  // two drives: inertia, gain, offset, two frictions
  EXPECT_GT(drives->scores.held_out, 2.0 * all->scores.held_out);
  const std::vector<KindShare> shares = kind_shares(*all, data.thinned(4));
  ASSERT_EQ(shares.size(), 4U);
  EXPECT_EQ(shares.front().kind, "masses, centres of mass and inertias");
  EXPECT_GT(shares.front().without, 5.0 * all->scores.held_out);
  for (const KindShare& one : shares) {
    EXPECT_TRUE(one.kind != "friction" || one.without < shares.front().without / 3.0) << one.without;
  }
}

std::vector<ToldValue> told_friction(const Truth& truth) {
  const Data data = pendulums::data(truth);
  const std::optional<WindowsFit> fit =
      standard_by_windows(pendulums::stated(), Freed::all, nullptr, data, 8, pendulums::silent);
  for (const KindShare& kind : kind_shares(fit.value(), data.thinned(4))) {
    if (kind.kind == "friction") {
      return kind.told;
    }
  }
  return {};
}

TEST(StandardWindows, TellTheFrictionThatIsThereAndNoOther) {
  EXPECT_TRUE(told_friction({}).empty());
  Truth truth;
  truth.viscous = 0.03;
  const std::vector<ToldValue> told = told_friction(truth);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].label, "viscous@elbow_motor:damping");
  EXPECT_NEAR(told[0].value, truth.viscous, 2.0 * told[0].deviation);
}

}  // namespace
}  // namespace plumbline::validation
