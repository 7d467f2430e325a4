// What goes in is stored or lost: the energy account of a run closes, the better the tighter the tolerance.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/limits/bench.h"

namespace plumbline::limits {
namespace {

constexpr double kSeconds = 1.0;
constexpr double kLoose = 1e-5;
constexpr double kTight = 1e-8;
constexpr double kBalance = 1e-5;

/// Energy that the account misses, as a share of what was exchanged.
double imbalance(const run::CommandedRun& run) { return std::abs(run.energy_error) / run.energy_exchanged; }

/// A place where the effect works in this experiment.
std::string place_for(const model::Model& model, effects::Place place) {
  return place == effects::Place::motor   ? "mLS"
         : place == effects::Place::ratio ? "leg_angle"
                                          : model.places(place).front();
}

struct Bench {
  model::Model model = leg_bench();
  validation::Experiment experiment = both_motors(model, kSeconds);
  run::CommandedRun run = simulate(model, experiment, options_at(kTight));
};

const Bench& bench() {
  static const Bench kBench;
  return kBench;
}

void expect_balance(const model::Model& model, const std::string& label) {
  const run::CommandedRun loose = simulate(model, bench().experiment, options_at(kLoose));
  const run::CommandedRun tight = simulate(model, bench().experiment, options_at(kTight));
  const double rough = imbalance(loose);
  const double fine = imbalance(tight);
  std::printf("%-34s %10.1e at %.0e, %10.1e at %.0e, exchanged %.3g J, %ld rates\n", label.c_str(), rough,
              kLoose, fine, kTight, tight.energy_exchanged, tight.summary.rate_evaluations);
  EXPECT_GT(tight.energy_exchanged, 0.1) << label;
  EXPECT_LT(fine, kBalance) << label;
  // A thousandfold tolerance must show, unless the account already closes to rounding.
  EXPECT_LT(fine, std::max(0.1 * rough, 1e-9)) << label;
}

model::Model with_law(const model::Model& model, const std::shared_ptr<const effects::Law>& law,
                      effects::Place place, const std::string& at) {
  return with_effect(model, law, at,
                     tenth_of_typical(*law, scales_of(bench().model, bench().run, place, at)));
}

TEST(EnergyBalance, BareModel) { expect_balance(bench().model, "bare"); }

class ForceEffect : public testing::TestWithParam<std::string> {};

TEST_P(ForceEffect, BalanceCloses) {
  const auto law = effects::Catalogue::all().find(GetParam());
  for (const effects::Place place : law->declaration().places) {
    const std::string at = place_for(bench().model, place);
    const model::Model model = with_law(bench().model, law, place, at);
    const run::CommandedRun run = simulate(model, bench().experiment, options_at(kTight));
    EXPECT_GT(largest_difference(run, bench().run), 1e-4) << GetParam() << " did nothing at " << at;
    expect_balance(model, GetParam() + " at " + at);
  }
}

std::vector<std::string> force_effects() {
  std::vector<std::string> names;
  const effects::Catalogue catalogue = effects::Catalogue::all();
  for (const auto& law : catalogue.laws()) {
    if (dynamic_cast<const effects::ForceLaw*>(law.get()) != nullptr) {
      names.push_back(law->declaration().name);
    }
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, ForceEffect, testing::ValuesIn(force_effects()),
                         [](const auto& chosen) { return chosen.param; });

TEST(EnergyBalance, ManyEffectsAtOnce) {
  model::Model model = bench().model;
  const effects::Catalogue catalogue = effects::Catalogue::all();
  using effects::Place;
  model = with_law(model, catalogue.find("coulomb"), Place::motor, "mLA");
  model = with_law(model, catalogue.find("lugre"), Place::motor, "mLS");
  model = with_law(model, catalogue.find("spring"), Place::coordinate, "thigh");
  model = with_law(model, catalogue.find("cable_stretch"), Place::ratio, "leg_angle");
  model = with_law(model, catalogue.find("cogging"), Place::motor, "mLA");
  model = with_law(model, catalogue.find("load_friction"), Place::motor, "mLS");
  model = with_law(model, catalogue.find("hard_stop"), Place::coordinate, "shin");
  model = with_effect(model, "torque_constant_error", "mLA", {0.9});
  model = with_effect(model, "actuator_lag", "mLS", {0.003});
  model = with_effect(model, "command_delay", "mLA", {0.0013});
  model = with_effect(model, "rotor_inertia", "mLA", {5e-5});
  model = with_effect(model, "added_mass", "shin", {0.2});
  model = with_effect(model, "gravity_tilt", model.places(Place::world).front(), {0.02, 0.03});
  expect_balance(model, "many");
}

}  // namespace
}  // namespace plumbline::limits
