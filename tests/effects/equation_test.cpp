// What a law's declaration writes down is what its code computes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "simulator/effects/inertial_sensor_law.h"
#include "simulator/effects/losing_sensor_law.h"
#include "tests/effects/expression.h"
#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

using Symbols = std::map<std::string, double>;

Symbols symbols_of(const Law& law, const Values& p, const std::vector<double>& states) {
  Symbols symbols;
  for (std::size_t i = 0; i < p.size(); ++i) symbols[law.declaration().parameters[i].name] = p[i];
  for (std::size_t i = 0; i < states.size(); ++i) symbols[law.declaration().states[i]] = states[i];
  return symbols;
}

void expect_close(double found, double written, const std::string& what) {
  EXPECT_NEAR(found, written, 1e-12 * (1.0 + std::abs(written))) << what;
}

TEST(WrittenEquation, IsTheForce) {
  Sampler sampler;
  for (const auto& law : force_laws()) {
    const std::string& name = law->declaration().name;
    const Equations equations(law->declaration().equation);
    double largest = 0.0;
    for (int i = 0; i < 200; ++i) {
      const Values p = sampler.parameters(*law);
      const Motion m = sampler.motion();
      const auto states = sampler.states(*law, p);
      Symbols symbols = symbols_of(*law, p, states);
      symbols["x"] = m.position;
      symbols["v"] = m.velocity;
      symbols["load"] = m.load;
      const double force = law->force(m, states.data(), p.data());
      largest = std::max(largest, std::abs(force));
      expect_close(force, equations.value("f", symbols), name);
      std::vector<double> rates(states.size());
      law->state_rate(m, states.data(), p.data(), rates.data());
      for (std::size_t k = 0; k < rates.size(); ++k) {
        expect_close(rates[k], equations.value(law->declaration().states[k] + "_rate", symbols), name);
      }
    }
    EXPECT_GT(largest, 0.0) << name << " was never seen to act";
  }
}

TEST(WrittenEquation, IsTheTorque) {
  Sampler sampler;
  int compared = 0;
  for (const auto& law : all_laws()) {
    const auto actuator = std::dynamic_pointer_cast<const ActuatorLaw>(law);
    if (!actuator) continue;
    const Equations equations(law->declaration().equation);
    if (!equations.defines("torque")) continue;  // a pure delay is no function of the present
    ++compared;
    for (int i = 0; i < 50; ++i) {
      const Values p = sampler.parameters(*law);
      const auto states = sampler.states(*law, p);
      const double u = sampler.between(-3, 3);
      Symbols symbols = symbols_of(*law, p, states);
      symbols["u"] = u;
      expect_close(actuator->torque(u, states.data(), p.data()), equations.value("torque", symbols),
                   law->declaration().name);
      std::vector<double> rates(states.size());
      actuator->state_rate(u, states.data(), p.data(), rates.data());
      for (std::size_t k = 0; k < rates.size(); ++k) {
        expect_close(rates[k], equations.value(law->declaration().states[k] + "_rate", symbols),
                     law->declaration().name);
      }
    }
  }
  EXPECT_EQ(compared, 6);
}

TEST(WrittenEquation, IsTheReading) {
  Sampler sampler;
  for (const auto& law : all_laws()) {
    const auto sensor = std::dynamic_pointer_cast<const SensorLaw>(law);
    if (!sensor) continue;
    if (std::dynamic_pointer_cast<const InertialSensorLaw>(law)) continue;  // inertial_sensor_test.cpp
    const Equations equations(law->declaration().equation);
    for (int i = 0; i < 50; ++i) {
      const Values p = sampler.parameters(*law);
      const double actual = sampler.between(-3, 3);
      Symbols symbols = symbols_of(*law, p, {});
      symbols["actual"] = actual;
      symbols["actual_rate"] = 0.0;
      if (const auto losing = std::dynamic_pointer_cast<const LosingSensorLaw>(law)) {
        symbols["lost"] = 0.0;
        symbols["actual_rate"] = sampler.between(-6, 6);
        expect_close(losing->loss_rate(symbols["actual_rate"], p.data()),
                     equations.value("lost_rate", symbols), law->declaration().name);
      }
      expect_close(sensor->reading(actual, p.data()), equations.value("reading", symbols),
                   law->declaration().name);
    }
  }
}

TEST(WrittenEquation, IsWhenASwitchReads) {
  Sampler sampler;
  int compared = 0;
  for (const auto& law : all_laws()) {
    const auto late = std::dynamic_pointer_cast<const SwitchLaw>(law);
    if (!late) continue;
    ++compared;
    const Equations equations(law->declaration().equation);
    const Values p = sampler.parameters(*law);
    Symbols symbols = symbols_of(*law, p, {});
    symbols["touchdown"] = 0.3;
    symbols["lift_off"] = 0.5;
    expect_close(0.3 + late->lateness(true, p.data()), equations.value("closing", symbols), "closing");
    expect_close(0.5 + late->lateness(false, p.data()), equations.value("opening", symbols), "opening");
  }
  EXPECT_EQ(compared, 1);
}

// The evaluator itself, against arithmetic done by hand.
TEST(Expression, FollowsPrecedenceBarsAndConditions) {
  const Equations e("a = 2 + 3*4^2/8; b = -|1 - x|*2; c = 5 if x > 3 else -x; d = max(a, b) - min(1, x)");
  EXPECT_DOUBLE_EQ(e.value("a", {}), 8.0);
  EXPECT_DOUBLE_EQ(e.value("b", {{"x", 4.0}}), -6.0);
  EXPECT_DOUBLE_EQ(e.value("c", {{"x", 4.0}}), 5.0);
  EXPECT_DOUBLE_EQ(e.value("c", {{"x", 2.0}}), -2.0);
  EXPECT_DOUBLE_EQ(e.value("d", {{"x", 4.0}}), 7.0);
  EXPECT_THROW(e.value("b", {}), std::runtime_error);
}

}  // namespace
}  // namespace plumbline::effects
