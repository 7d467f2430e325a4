// Energy is accounted for: force * velocity = - d(stored energy)/dt - lost power, for every law.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/sampling.h"

namespace plumbline::effects {
namespace {

constexpr int kSamples = 400;
constexpr double kStep =
    1e-6;  // central differences: error about step^2 and roundoff / step, both below 1e-8

class EveryForce : public testing::TestWithParam<std::shared_ptr<const ForceLaw>> {
 protected:
  const ForceLaw& law() const { return *GetParam(); }

  double slope_in_position(const Motion& m, const double* state, const double* p) const {
    Motion low = m, high = m;
    low.position -= kStep;
    high.position += kStep;
    return (law().stored_energy(high, state, p) - law().stored_energy(low, state, p)) / (2 * kStep);
  }

  double slope_in_state(const Motion& m, std::vector<double> states, std::size_t k, const double* p) const {
    const double center = states[k];
    const double step = kStep * (std::abs(center) + 1e-3);
    states[k] = center + step;
    const double high = law().stored_energy(m, states.data(), p);
    states[k] = center - step;
    return (high - law().stored_energy(m, states.data(), p)) / (2 * step);
  }

  /// dE/dt along the flow.
  double energy_rate(const Motion& m, const std::vector<double>& states, const double* p) const {
    std::vector<double> rates(states.size());
    law().state_rate(m, states.data(), p, rates.data());
    double rate = slope_in_position(m, states.data(), p) * m.velocity;
    for (std::size_t k = 0; k < states.size(); ++k) rate += slope_in_state(m, states, k, p) * rates[k];
    return rate;
  }

  bool switches_nearby(const Motion& m, const double* p) const {
    Motion low = m, high = m;
    low.position -= kStep;
    high.position += kStep;
    std::vector<double> a, b;
    law().switches(low, p, a);
    law().switches(high, p, b);
    for (std::size_t i = 0; i < a.size(); ++i) {
      if (a[i] * b[i] < 0.0) return true;
    }
    return false;
  }
};

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryForce, testing::ValuesIn(force_laws()),
                         [](const auto& each) { return each.param->declaration().name; });

/// What a drive gives less or more than the commanded torque, also at rest: power that its supply has.
bool draws_on_the_supply(const Law& law) {
  return law.declaration().name == "voltage_limit" || law.declaration().name == "torque_ripple";
}

std::vector<std::shared_ptr<const ForceLaw>> stateless_laws() {
  std::vector<std::shared_ptr<const ForceLaw>> result;
  for (const auto& law : force_laws()) {
    if (law->state_count() == 0 && !draws_on_the_supply(*law)) result.push_back(law);
  }
  return result;
}

class EveryStatelessForce : public EveryForce {};

INSTANTIATE_TEST_SUITE_P(Catalogue, EveryStatelessForce, testing::ValuesIn(stateless_laws()),
                         [](const auto& each) { return each.param->declaration().name; });

// At rest nothing is lost, so what is left of the force comes from the stored energy.
TEST_P(EveryStatelessForce, AtRestIsTheSlopeOfItsStoredEnergy) {
  Sampler sampler;
  for (int i = 0; i < kSamples; ++i) {
    const Values p = sampler.parameters(law());
    Motion m = sampler.motion();
    m.velocity = 0.0;
    if (switches_nearby(m, p.data())) continue;
    const double force = law().force(m, nullptr, p.data());
    EXPECT_NEAR(force, -slope_in_position(m, nullptr, p.data()), 1e-6 * (1.0 + std::abs(force)));
  }
}

TEST_P(EveryForce, BalancesItsPower) {
  Sampler sampler;
  for (int i = 0; i < kSamples; ++i) {
    const Values p = sampler.parameters(law());
    const Motion m = sampler.motion();
    const auto states = sampler.states(law(), p);
    if (switches_nearby(m, p.data())) continue;
    const double work = law().force(m, states.data(), p.data()) * m.velocity;
    const double loss = law().dissipated_power(m, states.data(), p.data());
    const double stored = energy_rate(m, states, p.data());
    const double size = std::abs(work) + std::abs(loss) + std::abs(stored);
    EXPECT_NEAR(work, -stored - loss, 1e-6 * (1.0 + size));
  }
}

TEST_P(EveryForce, LosesPowerUnlessItSaysOtherwise) {
  Sampler sampler;
  bool negative_seen = false;
  for (int i = 0; i < 10 * kSamples; ++i) {
    const Values p = sampler.parameters(law());
    const Motion m = sampler.motion();
    const auto states = sampler.states(law(), p);
    const double loss = law().dissipated_power(m, states.data(), p.data());
    const double roundoff = 1e-12 * std::abs(law().force(m, states.data(), p.data()) * m.velocity);
    if (loss < -roundoff) negative_seen = true;
  }
  EXPECT_EQ(negative_seen, !law().declaration().power_note.empty());
}

// The pairs that the notes name are passive together.
TEST(DirectionalFriction, IsPassiveBesideEnoughSymmetricFriction) {
  const Catalogue catalogue = Catalogue::all();
  for (const auto& [symmetric, directional, parameter] :
       {std::tuple{"viscous", "viscous_directional", "damping"},
        {"coulomb", "coulomb_directional", "level"}}) {
    const auto even = std::dynamic_pointer_cast<const ForceLaw>(catalogue.find(symmetric));
    const auto odd = std::dynamic_pointer_cast<const ForceLaw>(catalogue.find(directional));
    const Values p = values_of(*even, {{parameter, 0.4}});
    for (const double difference : {-0.4, 0.3, 0.4}) {
      const Values q = values_of(*odd, {{"difference", difference}});
      for (const double v : {-2.0, -0.01, -0.001, 0.001, 0.01, 2.0}) {
        const Motion m{0.0, v, 0.0};
        EXPECT_GE(even->dissipated_power(m, nullptr, p.data()) + odd->dissipated_power(m, nullptr, q.data()),
                  0.0);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::effects
