// A place that is sure where the law is not.
#include "validation/identify/diagnose/one_place.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"

namespace plumbline::validation {
namespace {

RankRow lead(const std::string& effect, const std::string& at, double share) {
  RankRow row;
  row.effect = effect;
  row.at = at;
  row.refitted = true;
  row.selected_share = share;
  return row;
}

class OnePlaceOf : public testing::Test {
 protected:
  const Policy policy_{};
  const model::Model model_ = pendulum_drive();
  const std::string motor_ = model_.motors.front().name;
  const std::string coordinate_ = model_.coordinates.front().name;
};

TEST_F(OnePlaceOf, LawsAtAMotorAndAtWhatItTurnsAreAtOnePlace) {
  const auto place = at_one_place(
      {lead("rotor_inertia", coordinate_, 0.32), lead("actuator_lag", motor_, 0.61)}, model_, policy_);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->at, motor_);
  EXPECT_NEAR(place->share, 0.93, 1e-12);
  ASSERT_EQ(place->laws.size(), 2U);
  EXPECT_EQ(place->laws.front().effect, "actuator_lag");
}

TEST_F(OnePlaceOf, SharesAtTwoPlacesAreNoAnswer) {
  const model::Model bench_model = bench();
  EXPECT_FALSE(
      at_one_place({lead("viscous", "mLA", 0.5), lead("viscous", "mLS", 0.45)}, bench_model, policy_));
}

TEST_F(OnePlaceOf, WhatIsHardlyChosenOrAloneIsNoAnswer) {
  EXPECT_FALSE(at_one_place({lead("viscous", motor_, 0.4), lead("coulomb", motor_, 0.2)}, model_, policy_));
  EXPECT_FALSE(at_one_place({lead("viscous", motor_, 0.95), lead("coulomb", motor_, 0.01)}, model_, policy_));
  EXPECT_FALSE(at_one_place({lead("viscous", motor_, 0.0)}, model_, policy_));
}

}  // namespace
}  // namespace plumbline::validation
