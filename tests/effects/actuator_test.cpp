// Actuator laws against their step responses and the numbers of Park et al. (2011).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/rk4.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

std::shared_ptr<const ActuatorLaw> law_named(const std::string& name) {
  return std::dynamic_pointer_cast<const ActuatorLaw>(Catalogue::all().find(name));
}

// Astrom and Murray, Feedback Systems: 1 - exp(-t/T).
TEST(ActuatorLag, FollowsAStepExponentially) {
  const auto law = law_named("actuator_lag");
  const double time_constant = 0.01;
  const Values p = values_of(*law, {{"time_constant", time_constant}});
  const Rate rate = [&](const State& s) {
    State r(1);
    law->state_rate(2.0, s.data(), p.data(), r.data());
    return r;
  };
  for (const double time : {0.003, 0.01, 0.05}) {
    const State s = rk4(rate, {0.0}, time, 1000);
    EXPECT_NEAR(law->torque(2.0, s.data(), p.data()), 2.0 * (1 - std::exp(-time / time_constant)), 1e-10);
  }
}

TEST(ActuatorLag, SettlesWhereItStays) {
  const auto law = law_named("actuator_lag");
  const Values p = values_of(*law, {{"time_constant", 0.01}});
  double state = 0.0, rate = 1.0;
  law->settle(-1.7, p.data(), &state);
  law->state_rate(-1.7, &state, p.data(), &rate);
  EXPECT_EQ(rate, 0.0);
  EXPECT_DOUBLE_EQ(law->torque(-1.7, &state, p.data()), -1.7);
}

TEST(ActuatorLag, StartsBelowAndAboveTheSamplePeriod) {
  const Scales scales = test_scales();
  const std::vector<Values> starts = law_named("actuator_lag")->starts(scales);
  EXPECT_LT(starts.front()[0], scales.period);
  EXPECT_GT(starts.back()[0], 5.0 * scales.period);
}

// Astrom and Murray, section 6.3: a step overshoots by exp(-pi zeta / sqrt(1 - zeta^2)) at t = pi / (w sqrt(1
// - zeta^2)).
TEST(CurrentLoop, OvershootsByTheTextbooksShare) {
  const auto law = law_named("current_loop");
  const double time_constant = 0.002, zeta = 0.4;
  const Values p = values_of(*law, {{"time_constant", time_constant}, {"damping_ratio", zeta}});
  const double root = std::sqrt(1.0 - zeta * zeta);
  const Rate rate = [&](const State& s) {
    State r(2);
    law->state_rate(-1.5, s.data(), p.data(), r.data());
    return r;
  };
  const double pi = 3.14159265358979323846;
  const State s = rk4(rate, {0.0, 0.0}, pi * time_constant / root, 2000);
  EXPECT_NEAR(law->torque(-1.5, s.data(), p.data()), -1.5 * (1.0 + std::exp(-pi * zeta / root)), 1e-9);
  EXPECT_NEAR(s[1], 0.0, 1e-6);
}

TEST(CurrentLoop, SettlesWhereItStays) {
  const auto law = law_named("current_loop");
  const Values p = values_of(*law, {{"time_constant", 0.01}});
  double state[2] = {0.0, 1.0};
  double rate[2] = {1.0, 1.0};
  law->settle(-1.7, p.data(), state);
  law->state_rate(-1.7, state, p.data(), rate);
  EXPECT_EQ(rate[0], 0.0);
  EXPECT_EQ(rate[1], 0.0);
  EXPECT_DOUBLE_EQ(law->torque(-1.7, state, p.data()), -1.7);
}

// Table VII (mLA left): bias 2.597e-2 N m.
TEST(TorqueBias, AddsToTheCommand) {
  const auto law = law_named("torque_bias");
  const Values p = values_of(*law, {{"bias", 2.597e-2}});
  EXPECT_NEAR(law->torque(1.0, nullptr, p.data()), 1.02597, 1e-15);
  EXPECT_NEAR(law->torque(0.0, nullptr, p.data()), 0.02597, 1e-15);
}

TEST(TorqueConstantError, ScalesTheCommand) {
  const auto law = law_named("torque_constant_error");
  const Values p = values_of(*law, {{"scale", 1.25}});
  EXPECT_DOUBLE_EQ(law->torque(-4.0, nullptr, p.data()), -5.0);
}

TEST(CommandDelay, ReportsItsDelayAndPassesTheCommandOn) {
  const auto law = law_named("command_delay");
  const Values p = values_of(*law, {{"delay", 0.004}});
  EXPECT_DOUBLE_EQ(law->delay(p.data()), 0.004);
  EXPECT_DOUBLE_EQ(law->torque(1.5, nullptr, p.data()), 1.5);
  EXPECT_EQ(law->starts(test_scales()), std::vector<Values>{Values{0.0}});
}

}  // namespace
}  // namespace plumbline::effects
