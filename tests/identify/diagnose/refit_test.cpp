// Which candidates are refitted, on twins of MABEL's leg on the bench.
#include <gmock/gmock.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/look_ahead.h"
#include "validation/identify/diagnose/race.h"

namespace plumbline::validation {
namespace {

// A short refit of the cable ends far above the floor, where a backlash could still compete.
TEST(Refit, OfTheOthersIsNotNeededOnceTheBestIsAtTheFloor) {
  const Data data = bench_twins({"cable_stretch@leg_angle:stiffness=3.5,damping=0.0889"}).thinned(24);
  const Tried tried =
      try_candidates(as_given(bench(), data), some_laws({"cable_stretch", "backlash"}), {}, data, {}, silent);
  ASSERT_GE(tried.candidates.size(), 4U);
  ASSERT_EQ(tried.refits.size(), 2U);
  const Refit& best = tried.refits.front();
  EXPECT_EQ(tried.candidates[static_cast<std::size_t>(best.candidate)].label(), "cable_stretch@leg_angle");
  EXPECT_TRUE(best.estimate.converged);
  EXPECT_LT(best.estimate.scores.train, 1.1);
}

// A lag of a two-hundredth of a sample takes more integrator steps than others, and a delay reaches the
// floor, too.
TEST(Refit, WhatTakesManyStepsIsTriedWhereItPromisesAsMuchAsTheBest) {
  const Data data = pendulum_twins({"actuator_lag@drive:time_constant=5e-6"}).thinned(24);
  const Tried tried = try_candidates(as_given(pendulum_drive(), data),
                                     some_laws({"actuator_lag", "command_delay"}), {}, data, {}, silent);
  const auto is_lag = [&](const Refit& one) {
    return tried.candidates[static_cast<std::size_t>(one.candidate)].label() == "actuator_lag@drive";
  };
  EXPECT_TRUE(std::any_of(tried.refits.begin(), tried.refits.end(), is_lag));
}

// A hard stop comes below 1.2 floors where a spring on one side is hidden, but not to the floor: a law whose
// promise is bad may still be the one that does, for a straight line says little of where it begins to act.
TEST(Refit, OfTheOthersIsNeededWhereTheBestIsNearTheFloorOnly) {
  const Data data = bench_twins({"unilateral_spring@leg_shape:stiffness=3.2,preload=0.08,rest=0.3293,side=-1,"
                                 "smoothing_length=0.005"})
                        .thinned(8);
  const Tried tried = try_candidates(as_given(bench(), data), some_laws({"hard_stop", "unilateral_spring"}),
                                     {}, data, {}, silent);
  std::vector<Hypothesis> hypotheses;
  for (const char* label : {"hard_stop@leg_shape", "hard_stop@shin", "unilateral_spring@leg_shape"}) {
    hypotheses.push_back(first_of(label, tried.hypotheses, tried.candidates));
  }
  hypotheses.back().promised_train = hypotheses.back().promised_held_out = 100.0;
  const std::vector<Refit> refits = refit(tried.stage, tried.candidates, hypotheses, data, {}, silent);
  ASSERT_EQ(refits.size(), 3U);
  const auto label = [&](const Refit& one) {
    return tried.candidates[static_cast<std::size_t>(one.candidate)].label();
  };
  EXPECT_EQ(label(refits[0]), "unilateral_spring@leg_shape");
  ASSERT_EQ(label(refits[1]), "hard_stop@leg_shape");
  EXPECT_GT(refits[1].estimate.predicted.scores.held_out, 1.1);
  EXPECT_LT(refits[1].estimate.predicted.scores.held_out, 1.2);
}

// The order of the linear predictions is turned about: the race is run, not read off.
TEST(Refit, ARaceIsWonByTheLawThatIsHidden) {
  const Data data = pendulum_twins({"coulomb@drive:level=0.0008"}).thinned(12);
  const Tried tried = screen_candidates(as_given(pendulum_drive(), data),
                                        some_laws({"coulomb", "quadratic", "torque_bias"}), {}, data, silent);
  std::vector<const Hypothesis*> entrants;
  for (const char* label : {"torque_bias@drive", "quadratic@drive", "coulomb@drive"}) {
    entrants.push_back(&first_of(label, tried.hypotheses, tried.candidates));
  }
  const std::vector<const Hypothesis*> winners = race(tried.stage, tried.candidates, entrants, data, silent);
  ASSERT_EQ(winners.size(), 3U);
  EXPECT_EQ(winners.front(), entrants.back());
}

}  // namespace
}  // namespace plumbline::validation
