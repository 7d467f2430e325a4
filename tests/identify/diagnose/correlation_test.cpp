// Which explanations of the same trials are one.
#include "validation/identify/diagnose/correlation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/identify/diagnose/bench.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class Explanations : public testing::Test {
 protected:
  Stage with(const std::string& effect) const {
    model::Model model = bench();
    model.effects.push_back(parse_effect(effect, model, effects::Catalogue::all()));
    return as_given(model, data_);
  }
  double between(const std::string& one, const std::string& other) const {
    return correlation(as_given(bench(), data_), with(one), with(other), data_);
  }
  Data data_ = bench_twins({"coulomb@mLA:level=0.02"}).thinned(6);
};

TEST_F(Explanations, AreOneWithThemselvesAndAtHalfTheirStrength) {
  EXPECT_NEAR(between("viscous@mLA:damping=0.004", "viscous@mLA:damping=0.004"), 1.0, 1e-9);
  EXPECT_NEAR(between("viscous@mLA:damping=0.004", "viscous@mLA:damping=0.002"), 1.0, 1e-2);
  EXPECT_NEAR(between("torque_bias@mLA:bias=0.02", "torque_bias@mLA:bias=-0.02"), -1.0, 1e-2);
}

// A constant force on the leg angle is one at the motor that drives it.
TEST_F(Explanations, ThatAreTheSameForceElsewhereAreOne) {
  EXPECT_GT(std::abs(between("torque_bias@mLA:bias=0.02", "preload@leg_angle:preload=0.47")), 0.999);
}

TEST_F(Explanations, OfOtherMotorsAreNot) {
  EXPECT_LT(std::abs(between("viscous@mLA:damping=0.004", "viscous@mLS:damping=0.004")), 0.5);
}

TEST_F(Explanations, ThatChangeNothingHaveNothingInCommon) {
  const Stage bare = as_given(bench(), data_);
  EXPECT_EQ(correlation(bare, bare, bare, data_), 0.0);
}

}  // namespace
}  // namespace plumbline::validation
