// Which of several refits is named.
#include "validation/identify/diagnose/choose.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/diagnose/objection.h"

namespace plumbline::validation {
namespace {

/// The window's squares times one of the factors in turn.
void set_squares(const std::vector<Eigen::VectorXd>& squares, const std::vector<double>& factors,
                 const Data& data, Refit& refit) {
  Prediction& predicted = refit.estimate.predicted;
  for (std::size_t w = 0; w < squares.size(); ++w) {
    predicted.square[w] = factors[w % factors.size()] * squares[w];
  }
  predicted.scores = score(data, predicted.square);
}

/// Coulomb friction is hidden, and it and viscous friction are tried.
class Choose : public testing::Test {
 protected:
  const Data data_ = bench_twins({"coulomb@mLA:level=0.02"}).thinned(8);
  const Policy options_{};
  Tried tried_ = try_candidates(as_given(bench(), data_), some_laws({"coulomb", "viscous"}), {}, data_,
                                options_, silent);

  /// Which of the two is named where Coulomb's leaves an error of `level` floors, and viscous friction, with
  /// a parameter less, so many times its square.
  int named_at(double level, double times) {
    tried_.refits.resize(2);
    Refit& coulomb = tried_.refits[0];
    Refit& viscous = tried_.refits[1];
    viscous.own = 0;
    set_squares(squares_, {level * level}, data_, coulomb);
    set_squares(squares_, {times * level * level}, data_, viscous);
    coulomb.estimate.scores = coulomb.estimate.predicted.scores;
    return choose(tried_.stage, tried_.refits, data_, options_).named;
  }

 private:
  const std::vector<Eigen::VectorXd> squares_ = tried_.refits.front().estimate.predicted.square;
};

// The hidden law itself is made impossible: the next best must not lose the resamples that it would have won.
TEST_F(Choose, AFlawedRefitTakesNoShareFromTheOthers) {
  ASSERT_GE(tried_.refits.size(), 2U);
  const auto label = [&](std::size_t refit) {
    return tried_.candidates[static_cast<std::size_t>(tried_.refits[refit].candidate)].label();
  };
  const Choice before = choose(tried_.stage, tried_.refits, data_, options_);
  ASSERT_EQ(before.named, 0);
  EXPECT_EQ(label(0), "coulomb@mLA");
  EXPECT_GT(before.shares[0], 0.9);

  Refit& best = tried_.refits.front();
  ASSERT_EQ(best.own, 1);
  const Eigen::Index level = best.estimate.theta.size() - 1;
  // Nothing at the best value for train is no flaw where train leaves it open and the held-out motion
  // decides.
  best.estimate.theta[level] = 0.0;
  EXPECT_EQ(flaw(best, data_, options_), "");
  best.extended.parameters.back().upper = best.estimate.predicted.theta[level];
  const Choice after = choose(tried_.stage, tried_.refits, data_, options_);
  EXPECT_THAT(after.objections[0], testing::HasSubstr("unphysical"));
  EXPECT_EQ(after.shares[0], 0.0);
  EXPECT_GT(after.shares[1], 0.9);
  EXPECT_NE(after.named, 0);
}

// Viscous friction takes fewer constants for granted than Coulomb's: it is named where it is nearly as good
// by chance, not where it is a little worse in every window.
TEST_F(Choose, FewerConstantsAreNoEvidence) {
  ASSERT_GE(tried_.refits.size(), 2U);
  tried_.refits.resize(2);
  Refit& coulomb = tried_.refits[0];
  Refit& viscous = tried_.refits[1];
  ASSERT_EQ(tried_.candidates[static_cast<std::size_t>(viscous.candidate)].label(), "viscous@mLA");
  const std::vector<Eigen::VectorXd> squares = coulomb.estimate.predicted.square;
  set_squares(squares, {1.03}, data_, viscous);
  EXPECT_EQ(choose(tried_.stage, tried_.refits, data_, options_).named, 0);
  set_squares(squares, {0.53, 1.53}, data_, viscous);
  ASSERT_GT(viscous.square(), coulomb.square());
  EXPECT_EQ(choose(tried_.stage, tried_.refits, data_, options_).named, 1);
}

// At the floor what is left is noise, and a law that leaves surely less is the better one though it has a
// parameter more. Above it all of them are wrong somewhere, and a little less is no evidence.
TEST_F(Choose, ASimplerLawIsPreferredWhereMoreThanNoiseIsLeft) {
  ASSERT_GE(tried_.refits.size(), 2U);
  constexpr double kWorse = 1.03;  // of the square
  EXPECT_EQ(named_at(1.0, kWorse), 0);
  EXPECT_EQ(named_at(1.5, kWorse), 1);
}

// Three thousandths of the squares of two windows are less than a further value costs, a hundredth is more.
TEST_F(Choose, AtTheFloorFurtherValuesNeedTheOdds) {
  const Data few = data_.thinned(1);
  Tried tried =
      try_candidates(as_given(bench(), few), some_laws({"coulomb", "viscous"}), {}, few, options_, silent);
  ASSERT_GE(tried.refits.size(), 2U);
  tried.refits.resize(2);
  Refit& coulomb = tried.refits[0];
  Refit& without_value = tried.refits[1];
  without_value.own = 0;
  const std::vector<Eigen::VectorXd> squares = coulomb.estimate.predicted.square;
  constexpr double kAtFloor = 0.7;
  set_squares(squares, {kAtFloor}, few, coulomb);
  coulomb.estimate.scores = coulomb.estimate.predicted.scores;
  ASSERT_LT(coulomb.estimate.scores.train, options_.at_floor);
  set_squares(squares, {1.003 * kAtFloor}, few, without_value);
  EXPECT_EQ(choose(tried.stage, tried.refits, few, options_).named, 1);
  set_squares(squares, {1.01 * kAtFloor}, few, without_value);
  EXPECT_EQ(choose(tried.stage, tried.refits, few, options_).named, 0);
}

// Far above the floor the constants of a law make up for what else is missing: a member of its family at its
// place that does nearly as well without them is named.
TEST_F(Choose, FarAboveTheFloorTheSimplerLawOfAFamilyIsEnough) {
  ASSERT_GE(tried_.refits.size(), 2U);
  EXPECT_EQ(named_at(2.0, 1.15 * 1.15), 0);
  EXPECT_EQ(named_at(10.0, 1.15 * 1.15), 1);
  EXPECT_EQ(named_at(10.0, 1.4 * 1.4), 0);
}

}  // namespace
}  // namespace plumbline::validation
