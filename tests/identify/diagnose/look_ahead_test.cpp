// Two hidden effects on twins of MABEL's leg on the bench, of which no single one is a good guess.
#include "validation/identify/diagnose/look_ahead.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/tangents.h"

namespace plumbline::validation {
namespace {

using testing::Contains;
using testing::Not;
using testing::StartsWith;
using testing::UnorderedElementsAre;

TEST(LookAhead, PutsTheTwoHiddenEffectsFirst) {
  const model::Model bare = bench();
  const Data data = bench_twins({"command_delay@mLS:delay=0.0014", "quadratic@mLS:drag=1.7e-5"}).thinned(8);
  const effects::Catalogue catalogue = some_laws({"command_delay", "quadratic", "viscous", "coulomb"});
  const Policy policy;
  const Tried tried = try_candidates(as_given(bare, data), catalogue, {}, data, policy, silent);
  ASSERT_FALSE(tried.refits.empty());
  EXPECT_GT(tried.refits.front().estimate.scores.held_out, 2.0);  // one alone is not enough
  const std::vector<Pair> pairs = look_ahead(tried, catalogue, data, policy, silent);
  ASSERT_FALSE(pairs.empty());
  EXPECT_THAT((std::vector<std::string>{pairs[0].first.label(), pairs[0].second.label()}),
              UnorderedElementsAre("command_delay@mLS", "quadratic@mLS"));
  EXPECT_LT(pairs[0].refit.estimate.scores.held_out, 1.1);
  EXPECT_EQ(pairs[0].refit.added.size(), 2U);
  EXPECT_EQ(pairs[0].refit.own, 2);
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    EXPECT_GE(pairs[i].refit.square(), pairs[i - 1].refit.square());
  }
  EXPECT_TRUE(halves_of(tried, pairs, data, policy, silent).empty());  // neither is enough
}

TEST(LookAhead, FollowsOnlyWhatExplainsSomethingAlone) {
  const Data data = bench_twins({"quadratic@mLS:drag=1.7e-5", "command_delay@mLA:delay=0.0014"}).thinned(8);
  const effects::Catalogue catalogue = some_laws({"quadratic", "torque_bias"});
  const Tried tried = try_candidates(as_given(bench(), data), catalogue, {}, data, {}, silent);
  ASSERT_GE(tried.refits.size(), 3U);
  std::set<std::string> followed;
  look_ahead(tried, catalogue, data, {}, [&](const std::string& what, double /*fraction*/) {
    if (what.rfind("with ", 0) == 0) {
      followed.insert(what.substr(5, what.find(':') - 5));
    }
  });
  EXPECT_THAT(followed, Contains("quadratic@mLS"));
  EXPECT_THAT(followed, Not(Contains(StartsWith("torque_bias"))));
}

// No simpler law promises anything of a mass that rattles, and laws with states of their own are tried like
// others.
TEST(LookAhead, TriesALawThatNoSimplerOnePromised) {
  const Data data = pendulum_twins({"resonator@shoulder:inertia=0.002,frequency=5.2,damping_ratio=0.09"});
  const Tried tried = try_candidates(as_given(pendulum_drive(), data),
                                     some_laws({"resonator", "torque_bias"}), {}, data, {}, silent);
  ASSERT_FALSE(tried.refits.empty());
  const Refit& best = tried.refits.front();
  EXPECT_EQ(tried.candidates[static_cast<std::size_t>(best.candidate)].label(), "resonator@shoulder");
  EXPECT_LT(best.estimate.scores.held_out, 1.1);
}

TEST(LookAhead, FindsTheHalfThatIsEnoughAlone) {
  const Data data = bench_twins({"coulomb@mLS:level=0.003"}).thinned(8);
  const Policy policy;
  const Tried tried =
      try_candidates(as_given(bench(), data), some_laws({"quadratic", "coulomb"}), {}, data, policy, silent);
  const std::vector<Pair> pairs =
      look_ahead(tried, some_laws({"quadratic", "coulomb"}), data, policy, silent);
  const std::vector<Refit> halves = halves_of(tried, pairs, data, policy, silent);
  ASSERT_EQ(halves.size(), 1U);
  const Refit& alone = halves.front();
  EXPECT_EQ(tried.candidates[static_cast<std::size_t>(alone.candidate)].label(), "coulomb@mLS");
  EXPECT_EQ(alone.own, 1);
  EXPECT_NEAR(alone.estimate.theta[0], 0.003, 3e-4);
  EXPECT_LT(alone.estimate.scores.held_out, 1.1);
}

struct Screened {
  Data data;
  Stage stage;
  std::vector<Candidate> candidates;
  std::vector<Hypothesis> starts;
};

/// On the bench's twins: all candidates of the laws, and all starts of each.
Screened screened(const Data& data, const std::set<std::string>& laws) {
  Screened all{data, as_given(bench(), data), {}, {}};
  PredictorPool pool(all.stage.model, data);
  all.candidates = list_candidates(pool, some_laws(laws), {}, all.stage.estimate);
  for (std::size_t c = 0; c < all.candidates.size(); ++c) {
    for (const effects::Values& start : all.candidates[c].law->starts(all.candidates[c].scales)) {
      Hypothesis hypothesis;
      hypothesis.candidate = static_cast<int>(c);
      hypothesis.start = start;
      all.starts.push_back(hypothesis);
    }
  }
  return all;
}

TEST(Tangents, PromiseMostForThePairThatIsHidden) {
  const auto [data, stage, candidates, starts] =
      screened(bench_twins({"hardening@leg_angle:cubic_stiffness=3", "coulomb@mLS:level=0.003"}).thinned(8),
               {"hardening", "spring", "coulomb", "viscous", "quadratic", "torque_bias"});
  const std::vector<PairHypothesis> pairs = Tangents(stage, candidates, starts, data).pairs(8);
  ASSERT_EQ(pairs.size(), 8U);
  const auto label = [&all = candidates](const Hypothesis& h) {
    return all[static_cast<std::size_t>(h.candidate)].label();
  };
  EXPECT_THAT((std::vector<std::string>{label(pairs[0].first), label(pairs[0].second)}),
              UnorderedElementsAre("hardening@leg_angle", "coulomb@mLS"));
  EXPECT_LT(pairs[0].promised(), 0.5 * pairs[2].promised());
  std::set<std::set<std::string>> different;
  for (const PairHypothesis& pair : pairs) {
    different.insert({label(pair.first), label(pair.second)});
  }
  EXPECT_EQ(different.size(), pairs.size());  // whatever the starts
}

TEST(Tangents, PromiseInLotsWhatTheyPromiseInOneLinearisation) {
  const auto [data, stage, candidates, starts] = screened(
      bench_twins({"cogging@mLS:sine=0.02,cycles=12"}).thinned(2), {"cogging", "torque_ripple", "viscous"});
  const std::vector<Hypothesis> in_one = Tangents(stage, candidates, starts, data).promises();
  const std::vector<Hypothesis> in_lots = promises_of(stage, candidates, starts, data);
  ASSERT_EQ(in_one.size(), in_lots.size());
  ASSERT_LT(first_lot(candidates, starts).size(), starts.size());  // there are several lots
  for (std::size_t h = 0; h < in_one.size(); ++h) {
    EXPECT_EQ(in_one[h].candidate, in_lots[h].candidate);
    EXPECT_NEAR(in_one[h].promised(), in_lots[h].promised(), 1e-6 * in_one[h].promised());
    EXPECT_LT((in_one[h].step - in_lots[h].step).norm(), 1e-5 * in_one[h].step.norm() + 1e-9);
  }
}

TEST(Tangents, BeginALotWithTheBestStartOfEachCandidate) {
  const Screened all = screened(bench_twins({"viscous@mLS:damping=0.001"}).thinned(2),
                                {"cogging", "torque_ripple", "viscous"});
  const std::vector<Hypothesis> lot = first_lot(all.candidates, all.starts);
  std::set<int> seen;
  for (std::size_t h = 0; h < all.candidates.size(); ++h) {
    seen.insert(lot[h].candidate);
  }
  EXPECT_EQ(seen.size(), all.candidates.size());
}

}  // namespace
}  // namespace plumbline::validation
