// Drives: what windings, iron and gears do to a torque, against what textbooks give for them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/effects/rk4.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

std::shared_ptr<const ForceLaw> force_named(const std::string& name) {
  return std::dynamic_pointer_cast<const ForceLaw>(Catalogue::all().find(name));
}

std::shared_ptr<const ActuatorLaw> actuator_named(const std::string& name) {
  return std::dynamic_pointer_cast<const ActuatorLaw>(Catalogue::all().find(name));
}

// A winding of R ohm at U volt, with K N m/A = K V s/rad.
constexpr double kR = 0.8, kU = 24.0, kK = 0.05;

Values winding(const Law& law) {
  return values_of(law, {{"stall_torque", kK * kU / kR}, {"no_load_speed", kU / kK}});
}

// Asked for more than it can give, a motor runs up as v = v0 (1 - exp(-t/T)), T = J R/K^2 (Fitzgerald,
// Kingsley and Umans: the electromechanical time constant).
TEST(VoltageLimit, RunsUpWithTheElectromechanicalTimeConstant) {
  const auto law = force_named("voltage_limit");
  const Values p = winding(*law);
  const double inertia = 2e-4, asked = 10.0;
  const double time_constant = inertia * kR / (kK * kK);
  const Rate rate = [&](const State& x) {
    return State{(asked + law->force({0.0, x[0], asked}, nullptr, p.data())) / inertia};
  };
  for (const double time : {0.01, 0.05, 0.2}) {
    EXPECT_NEAR(rk4(rate, {0.0}, time, 2000)[0], kU / kK * (1.0 - std::exp(-time / time_constant)), 1e-6);
  }
}

// Ohm's law of the circuit: the current i = load/K flows while |R i + K v| <= U.
TEST(VoltageLimit, GivesTheCurrentThatTheCircuitAllows) {
  const auto law = force_named("voltage_limit");
  const Values p = winding(*law);
  for (const double v : {-700.0, -300.0, 0.0, 120.0, 470.0, 900.0}) {
    for (const double load : {-3.0, -1.0, -0.05, 0.0, 0.2, 1.4, 5.0}) {
      const double voltage = kR * load / kK + kK * v;
      const double current = std::abs(voltage) <= kU ? load / kK : (std::copysign(kU, voltage) - kK * v) / kR;
      EXPECT_NEAR(load + law->force({0.3, v, load}, nullptr, p.data()), kK * current, 1e-12);
    }
  }
}

TEST(VoltageLimit, WithoutBackEmfIsALimitOfTorque) {
  const auto law = force_named("voltage_limit");
  const Values p = values_of(*law, {{"stall_torque", 2.0}});
  EXPECT_EQ(law->force({0.0, 1e4, 1.9}, nullptr, p.data()), 0.0);
  EXPECT_DOUBLE_EQ(law->force({0.0, 1e4, 3.0}, nullptr, p.data()), -1.0);
  EXPECT_DOUBLE_EQ(law->force({0.0, -1e4, -3.0}, nullptr, p.data()), 1.0);
}

// Straight at first, at a saturation torque T 1/sqrt(2) of what is asked for, T in the end.
TEST(TorqueSaturation, BendsFromTheStraightLineToItsLimit) {
  const auto law = actuator_named("torque_saturation");
  const double limit = 3.0;
  const Values p = values_of(*law, {{"sag", 1.0 / (limit * limit)}});
  EXPECT_NEAR(law->torque(1e-3, nullptr, p.data()), 1e-3, 1e-10);
  EXPECT_NEAR(law->torque(-limit, nullptr, p.data()), -limit / std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(law->torque(1e6, nullptr, p.data()), limit, 1e-9);
}

// Output over input power is the efficiency, which is another one backwards. Away from standstill.
TEST(GearEfficiency, LosesItsShareOfThePowerEitherWay) {
  const auto law = force_named("gear_efficiency");
  const double driving = 0.8, driven = 0.6;
  const Values p = values_of(*law, {{"loss_driving", 1.0 / driving - 1.0}, {"loss_driven", 1.0 - driven}});
  for (const double load : {-4.0, 4.0}) {
    for (const double v : {-2.0, 2.0}) {
      const double loss = law->dissipated_power({0.0, v, load}, nullptr, p.data());
      const double passed = std::abs(load * v);
      if (load * v > 0.0) {
        EXPECT_NEAR(passed / (passed + loss), driving, 1e-12);
      } else {
        EXPECT_NEAR((passed - loss) / passed, driven, 1e-12);
      }
    }
  }
}

// A worm that loses all when it is driven holds whatever load moves it.
TEST(GearEfficiency, LocksItselfWhereNothingIsLeft) {
  const auto law = force_named("gear_efficiency");
  const Values p = values_of(*law, {{"loss_driving", 1.5}, {"loss_driven", 1.0}});
  EXPECT_NEAR(law->force({0.0, -1.0, 2.5}, nullptr, p.data()), 2.5, 1e-12);
}

TEST(GearEfficiency, WithEqualLossesIsGearFriction) {
  const auto law = force_named("gear_efficiency");
  const auto friction = force_named("gear_friction");
  const Values p = values_of(*law, {{"loss_driving", 0.2}, {"loss_driven", 0.2}});
  const Values q = values_of(*friction, {{"coefficient", 0.2}});
  for (const double v : {-1.0, -0.004, 0.0, 0.003, 1.0}) {
    const Motion m{0.1, v, -1.7};
    EXPECT_NEAR(law->force(m, nullptr, p.data()), friction->force(m, nullptr, q.data()), 1e-15);
  }
}

}  // namespace
}  // namespace plumbline::effects
