// Names beside which more is left than they explain.
#include <gtest/gtest.h>

#include <limits>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {
namespace {

/// Much friction, and an encoder whose zero is off.
Data friction_and_zero() {
  return pendulum_twins({"viscous@drive:damping=0.0004", "encoder_offset@shoulder:offset=0.15"}).thinned(4);
}

/// A diagnosis that has named this one effect and is far from the floor.
Diagnosis with_name(const std::string& label, const Data& data) {
  const Stage given = as_given(pendulum_drive(), data);
  const Tried tried = try_candidates(given, some_laws({"viscous", "encoder_offset"}), {}, data, {}, silent);
  const Refit& refit = first_of(label, tried.refits, tried.candidates);
  Diagnosis diagnosis;
  Finding finding = finding_of(tried.candidates[static_cast<std::size_t>(refit.candidate)]);
  set_errors(given.estimate, refit.estimate, finding);
  diagnosis.accepted = {finding};
  constexpr double kWhole = std::numeric_limits<double>::infinity();
  diagnosis.ladder = {{"as given", given, kWhole}, {"+ " + label, after(refit), kWhole}};
  diagnosis.final_stage = after(refit);
  return diagnosis;
}

TEST(Doubtful, WhatLeavesMoreThanItExplainsIsNoName) {
  const Data data = friction_and_zero();
  Diagnosis zero = with_name("encoder_offset@shoulder", data);
  ASSERT_LT(zero.accepted[0].held_out_after, 0.95 * zero.accepted[0].held_out_before);
  leave_doubtful_unnamed(data, {}, silent, zero);
  EXPECT_TRUE(zero.accepted.empty());
  ASSERT_TRUE(zero.unnamed);
  EXPECT_LT(judged(zero.unnamed->stage.estimate, data), judged(zero.final_stage.estimate, data));

  Diagnosis friction = with_name("viscous@drive", data);
  ASSERT_GT(friction.accepted[0].held_out_after, 1.2);
  leave_doubtful_unnamed(data, {}, silent, friction);
  EXPECT_EQ(friction.accepted.size(), 1U);
}

}  // namespace
}  // namespace plumbline::validation
