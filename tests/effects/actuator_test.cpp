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

constexpr double kAmbient = 293.15;

/// Temperatures of winding and housing after `duration` under a torque that is held.
State warmed(const ActuatorLaw& law, const Values& p, double u, double duration) {
  return rk4(
      [&](const State& s) {
        State r(2);
        law.state_rate(u, s.data(), p.data(), r.data());
        return r;
      },
      {kAmbient, kAmbient}, duration, 20000);
}

// One thermal mass on a housing that stays cold, of a resistance that does not change: T = P R (1 -
// exp(-t/RC)).
TEST(ThermalMotor, WarmsItsWindingExponentially) {
  const auto law = law_named("thermal_motor");
  const double heating = 0.7, winding_time = 25.0, u = 2.0;
  const Values p = values_of(*law, {{"copper_sag", 3.9e-3},
                                    {"heating", heating},
                                    {"winding_time", winding_time},
                                    {"share", 0.0},
                                    {"copper", 0.0}});
  for (const double time : {5.0, 25.0, 200.0}) {
    const State s = warmed(*law, p, u, time);
    const double rise = heating * u * u * winding_time * (1.0 - std::exp(-time / winding_time));
    EXPECT_NEAR(s[0] - kAmbient, rise, 1e-8);
    EXPECT_NEAR(law->torque(u, s.data(), p.data()), u / (1.0 + 3.9e-3 * rise), 1e-10);
  }
}

// In the end the heat that the copper makes goes out through both resistances, one behind the other.
TEST(ThermalMotor, EndsWhereHeatInIsHeatOut) {
  const auto law = law_named("thermal_motor");
  const double heating = 0.02, winding_time = 20.0, housing_time = 90.0, share = 0.2, copper = 3.9e-3,
               u = -3.0;
  const Values p = values_of(*law, {{"magnet_sag", 1.5e-3},
                                    {"heating", heating},
                                    {"winding_time", winding_time},
                                    {"housing_time", housing_time},
                                    {"share", share}});
  const State s = warmed(*law, p, u, 5000.0);
  const double resistances = winding_time + share * housing_time;  // of both, in kelvin per heating
  const double rise = heating * u * u * resistances / (1.0 - heating * u * u * resistances * copper);
  EXPECT_NEAR(s[0] - kAmbient, rise, 1e-6);
  EXPECT_NEAR(s[1] - kAmbient, rise * share * housing_time / resistances, 1e-6);
  EXPECT_NEAR(law->torque(u, s.data(), p.data()), u * (1.0 - 1.5e-3 * (s[1] - kAmbient)), 1e-12);
}

TEST(ThermalMotor, BeginsColdWhateverIsCommanded) {
  const auto law = law_named("thermal_motor");
  const Values p = values_of(*law, {{"copper_sag", 3.9e-3}});
  double state[2] = {0.0, 0.0};
  law->settle(7.0, p.data(), state);
  EXPECT_DOUBLE_EQ(law->torque(7.0, state, p.data()), 7.0);
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

TEST(BusDelay, IsACommandDelayOfEveryMotorThere) {
  const auto law = law_named("bus_delay");
  const Values p = values_of(*law, {{"delay", 0.004}});
  EXPECT_DOUBLE_EQ(law->delay(p.data()), 0.004);
  EXPECT_DOUBLE_EQ(law->torque(1.5, nullptr, p.data()), 1.5);
  EXPECT_TRUE(law->sits_at(Place::limb));
}

}  // namespace
}  // namespace plumbline::effects
