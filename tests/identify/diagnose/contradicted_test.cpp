// A law whose strength the held-out motion does not ask for.
#include "validation/identify/diagnose/contradicted.h"

#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {
namespace {

/// Train trials with one offset of a motor's torque in them, the held-out one with another.
Data with_offsets(const std::string& train, const std::string& held_out) {
  std::vector<Trial> trials = bench_twins({"torque_bias@mLA:bias=" + train}).trials;
  const std::vector<Trial> others = bench_twins({"torque_bias@mLA:bias=" + held_out}).trials;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    if (trials[t].role == Role::held_out) {
      trials[t] = others[t];
    }
  }
  return Data(std::move(trials), {}).thinned(4);
}

double asked(const Data& data) {
  const Tried tried =
      try_candidates(as_given(bench(), data), some_laws({"torque_bias"}), {}, data, {}, silent);
  const Refit& offset = first_of("torque_bias@mLA", tried.refits, tried.candidates);
  return asked_otherwise(after(offset), offset.added.front(), data);
}

TEST(Contradicted, TheSameStrengthIsAskedForWhereTheMotionsAgree) {
  EXPECT_LT(asked(with_offsets("0.02", "0.02")), 0.2);
}

TEST(Contradicted, NoneOfItWhereTheyDoNot) { EXPECT_GT(asked(with_offsets("0.02", "-0.012")), 1.0); }

}  // namespace
}  // namespace plumbline::validation
