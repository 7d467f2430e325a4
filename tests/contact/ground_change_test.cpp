// Errors of the ground: what the foot's own laws become of them.
#include "contact/ground_change.h"

#include <gtest/gtest.h>

#include <cmath>

#include "contact/laws.h"
#include "tests/contact/values.h"

namespace plumbline::contact {
namespace {

std::shared_ptr<const effects::Law> law_named(const std::string& name) {
  for (const auto& law : ground_laws()) {
    if (law->declaration().name == name) {
      return law;
    }
  }
  throw std::invalid_argument("no law " + name);
}

GroundChange change_of(const std::string& name, double value) {
  return dynamic_cast<const GroundChangeLaw&>(*law_named(name)).change(&value);
}

TEST(GroundChange, IsNothingAtTheNullValues) {
  for (const auto& [name, null] : {std::pair<const char*, double>{"ground_stiffness_error", 1.0},
                                   {"ground_damping_error", 1.0},
                                   {"ground_friction_error", 1.0},
                                   {"ground_height_error", 0.0}}) {
    EXPECT_EQ(law_named(name)->null_values(), effects::Values{null});
    const GroundChange change = change_of(name, null);
    EXPECT_EQ(change.stiffness, 1.0) << name;
    EXPECT_EQ(change.damping, 1.0) << name;
    EXPECT_EQ(change.friction, 1.0) << name;
    EXPECT_EQ(change.height, 0.0) << name;
  }
}

// Force of a Hertzian ground written out: s^1.5 (k + lambda r).
TEST(GroundChange, ScalesTheElasticAndTheDampingForceApart) {
  const auto law = std::dynamic_pointer_cast<const NormalLaw>(law_named("ground_normal"));
  const effects::Values p = values_of(*law, {{"stiffness", 2e6}, {"damping", 4e5}});
  const double depth = 2e-3;
  const double rate = 0.7;
  const auto force_with = [&](const std::string& name, double value) {
    effects::Values changed = p;
    law->apply(change_of(name, value), changed.data());
    return law->force(depth, rate, changed.data());
  };
  const double share = std::pow(depth, 1.5);
  EXPECT_NEAR(force_with("ground_stiffness_error", 1.3), share * (1.3 * 2e6 + 4e5 * rate), 1e-9);
  EXPECT_NEAR(force_with("ground_damping_error", 0.6), share * (2e6 + 0.6 * 4e5 * rate), 1e-9);
  EXPECT_EQ(force_with("ground_friction_error", 2.0), law->force(depth, rate, p.data()));
}

// Sliding steadily, LuGre's bristles give normal (friction + viscous v).
TEST(GroundChange, ScalesTheFrictionOfSteadySliding) {
  const auto law = std::dynamic_pointer_cast<const TangentialLaw>(law_named("ground_friction"));
  effects::Values p = values_of(*law, {{"bristle_stiffness", 260}, {"friction", 0.5}, {"viscous", 0.1}});
  law->apply(change_of("ground_friction_error", 1.4), p.data());
  const Eigen::Vector2d slip(0.8, 0.0);
  const Eigen::Vector2d bent(0.5 / 260, 0.0);
  Eigen::Vector2d rate;
  law->state_rate(slip, 100.0, bent.data(), p.data(), rate.data());
  EXPECT_NEAR(rate.x(), 0.0, 1e-12);  // steady where it was steady before
  EXPECT_NEAR(law->force(slip, 100.0, bent.data(), p.data()).x(), -100.0 * 1.4 * (0.5 + 0.1 * 0.8), 1e-9);
}

TEST(GroundChange, ScalesCoulombFrictionAndKeepsTheSpeedAtWhichItFades) {
  const auto law = std::dynamic_pointer_cast<const TangentialLaw>(law_named("ground_coulomb"));
  effects::Values p = values_of(*law, {{"friction", 0.3}, {"viscous", 0.1}, {"slip_speed", 0.02}});
  law->apply(change_of("ground_friction_error", 1.4), p.data());
  for (const double speed : {0.004, 0.8}) {
    const double expected = -100.0 * 1.4 * (0.3 * std::tanh(speed / 0.02) + 0.1 * speed);
    EXPECT_NEAR(law->force({0.0, speed}, 100.0, nullptr, p.data()).y(), expected, 1e-9) << speed;
  }
}

}  // namespace
}  // namespace plumbline::contact
