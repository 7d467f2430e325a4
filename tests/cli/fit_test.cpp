// What `plumbline fit` says of its numbers: intervals and doubts.
#include "validation/identify/fit/fit.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

FreeParameter parameter(const std::string& label, effects::Scale scale = effects::Scale::linear,
                        double lower = -kInfinity, double upper = kInfinity) {
  FreeParameter made;
  made.label = label;
  made.unit = "N m";
  made.scale = scale;
  made.lower = lower;
  made.upper = upper;
  made.typical = 1.0;
  return made;
}

/// `side` is the deviation where the value is searched.
FitNumbers numbers(double after, double deviation, int windows, double side) {
  const auto one = [](double value) { return Eigen::VectorXd::Constant(1, value); };
  FitNumbers made;
  made.before = Eigen::VectorXd::Zero(1);
  made.after = one(after);
  made.precision = {one(deviation), one(side), one(side), one(windows - 1.0), Eigen::MatrixXd::Ones(1, 1)};
  return made;
}

FitNumbers numbers(double after, double deviation, int windows) {
  return numbers(after, deviation, windows, deviation);
}

std::vector<std::string> kinds(const FittedParameter& fitted) {
  std::vector<std::string> all;
  for (const Doubt& doubt : fitted.doubts) {
    all.push_back(doubt.kind);
  }
  return all;
}

// Table of the t distribution: R. A. Fisher and F. Yates, Statistical Tables (1963), table III, P = 0.05.
TEST(StudentQuantile, IsThatOfTheTables) {
  EXPECT_NEAR(student_quantile(0.95, 1), 12.706, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 10), 2.228, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 30), 2.042, 5e-4);
  EXPECT_NEAR(student_quantile(0.95, 1000000), 1.960, 5e-4);
  EXPECT_TRUE(std::isinf(student_quantile(0.95, 0)));
}

TEST(Judge, LinearIntervalIsSymmetric) {
  const FittedParameter fitted = judge({parameter("a")}, numbers(3.0, 0.1, 11), {}).front();
  EXPECT_NEAR(fitted.lower, 3.0 - 0.2228, 1e-4);
  EXPECT_NEAR(fitted.upper, 3.0 + 0.2228, 1e-4);
  EXPECT_TRUE(fitted.doubts.empty());
}

TEST(Judge, IntervalAlongALogarithmStaysPositive) {
  const FittedParameter fitted =
      judge({parameter("a", effects::Scale::logarithm, 1e-9)}, numbers(2.0, 1.6, 11, 0.8), {}).front();
  EXPECT_NEAR(fitted.lower, 2.0 * std::exp(-0.8 * 2.228), 1e-3);
  EXPECT_NEAR(fitted.upper, 2.0 * std::exp(0.8 * 2.228), 1e-2);
}

TEST(Judge, IntervalOfAStiffnessReachesToRigidWhenItCannotBeToldFromIt) {
  // 1/k = 0.01 with deviation 50/100^2 = 0.005 on the reciprocal: 0.01 - 2.228 * 0.005 < 0.
  const FittedParameter fitted =
      judge({parameter("a", effects::Scale::reciprocal, 1e-9)}, numbers(100.0, 50.0, 11, 0.005), {}).front();
  EXPECT_NEAR(fitted.lower, 1.0 / (0.01 + 2.228 * 0.005), 1e-2);
  EXPECT_TRUE(std::isinf(fitted.upper));
}

TEST(Judge, IntervalStopsAtTheBounds) {
  const FittedParameter fitted =
      judge({parameter("a", effects::Scale::linear, 0.0)}, numbers(0.1, 0.2, 11), {}).front();
  EXPECT_EQ(fitted.lower, 0.0);
}

TEST(Judge, IntervalFollowsUnlikeSides) {
  FitNumbers unlike = numbers(2.0, 1.0, 11, 0.5);
  unlike.precision.above[0] = 0.1;
  const FreeParameter along = parameter("a", effects::Scale::logarithm, 1e-9);
  const FittedParameter fitted = judge({along}, unlike, {}).front();
  EXPECT_NEAR(fitted.lower, 2.0 * std::exp(-0.5 * 2.228), 1e-3);
  EXPECT_NEAR(fitted.upper, 2.0 * std::exp(0.1 * 2.228), 1e-3);
  unlike.precision.above[0] = kInfinity;
  EXPECT_TRUE(std::isinf(judge({along}, unlike, {}).front().upper));
  EXPECT_EQ(judge({parameter("a", effects::Scale::linear, 0.0, 5.0)}, unlike, {}).front().upper, 5.0);
}

TEST(Judge, DoubtsAValueKnownToMoreThanHalfOfItself) {
  EXPECT_THAT(kinds(judge({parameter("a")}, numbers(1.0, 0.51, 20), {}).front()),
              testing::ElementsAre("uncertain"));
  EXPECT_TRUE(judge({parameter("a")}, numbers(1.0, 0.49, 20), {}).front().doubts.empty());
  EXPECT_TRUE(judge({parameter("a")}, numbers(-1.0, 0.49, 20), {}).front().doubts.empty());
}

TEST(Judge, DoubtsAValueAtABound) {
  const std::vector<FreeParameter> bounded{parameter("a", effects::Scale::linear, 0.0, 5.0)};
  const FittedParameter low = judge(bounded, numbers(0.0, 0.0, 20), {}).front();
  EXPECT_THAT(kinds(low), testing::ElementsAre("at_bound"));
  EXPECT_THAT(low.doubts[0].text, testing::HasSubstr("its lower bound 0 N m"));
  const FittedParameter high = judge(bounded, numbers(5.0, 0.1, 20), {}).front();
  EXPECT_THAT(high.doubts[0].text, testing::HasSubstr("its upper bound 5 N m"));
}

TEST(Judge, DoubtsParametersThatMoveTogether) {
  FitNumbers two;
  two.before = Eigen::VectorXd::Zero(3);
  two.after = Eigen::VectorXd::Ones(3);
  Eigen::MatrixXd correlation = Eigen::MatrixXd::Identity(3, 3);
  correlation(0, 2) = correlation(2, 0) = -0.99;
  correlation(0, 1) = correlation(1, 0) = 0.5;
  const Eigen::VectorXd tenth = Eigen::VectorXd::Constant(3, 0.1);
  two.precision = {tenth, tenth, tenth, Eigen::VectorXd::Constant(3, 27.0), correlation};
  const auto fitted = judge({parameter("a"), parameter("b"), parameter("c")}, two, {});
  EXPECT_EQ(fitted[0].partner, "c");
  EXPECT_EQ(fitted[0].correlation, -0.99);
  EXPECT_THAT(kinds(fitted[0]), testing::ElementsAre("tied"));
  EXPECT_EQ(fitted[1].partner, "a");
  EXPECT_TRUE(fitted[1].doubts.empty());
  EXPECT_THAT(kinds(fitted[2]), testing::ElementsAre("tied"));
}

TEST(Judge, SaysWhenTheDataDoNotSeeAParameter) {
  FitNumbers unseen = numbers(1.0, 0.0, 20);
  unseen.precision.correlation(0, 0) = 0.0;
  const FittedParameter fitted = judge({parameter("a")}, unseen, {}).front();
  EXPECT_FALSE(fitted.seen());
  EXPECT_TRUE(std::isinf(fitted.deviation));
  EXPECT_THAT(kinds(fitted), testing::ElementsAre("unseen"));
}

TEST(Judge, SaysWhenThereAreTooFewWindows) {
  const FittedParameter fitted =
      judge({parameter("a", effects::Scale::linear, 0.0, 5.0)}, numbers(1.0, 0.1, 1), {}).front();
  EXPECT_THAT(kinds(fitted), testing::ElementsAre("few_windows"));
  EXPECT_EQ(fitted.lower, 0.0);
  EXPECT_EQ(fitted.upper, 5.0);
}

TEST(Matching, TakesShellPatterns) {
  const std::vector<FreeParameter> all{parameter("viscous@mLA:damping"), parameter("viscous@mLS:damping"),
                                       parameter("coulomb@mLA:level")};
  const auto labels = [&](const std::vector<std::string>& patterns) {
    std::vector<std::string> found;
    for (const FreeParameter& one : matching(all, patterns)) {
      found.push_back(one.label);
    }
    return found;
  };
  EXPECT_EQ(labels({"*"}).size(), 3U);
  EXPECT_THAT(labels({"*@mLA:*"}), testing::ElementsAre("viscous@mLA:damping", "coulomb@mLA:level"));
  EXPECT_THAT(labels({"viscous@mL?:damping", "*:damping"}),
              testing::ElementsAre("viscous@mLA:damping", "viscous@mLS:damping"));
  EXPECT_THROW(matching(all, {"*", "backlash*"}), InputError);
  EXPECT_THROW(matching({}, {"*"}), InputError);
}

}  // namespace
}  // namespace plumbline::validation
