// Models nest: an effect at its null values leaves the model as it was.
#include <gtest/gtest.h>

#include <random>

#include "simulator/effects/inertial_sensor_law.h"
#include "simulator/model/places.h"
#include "tests/limits/bench.h"

namespace plumbline::limits {
namespace {

constexpr double kRelative = 1e-12;

struct Probe {
  Eigen::VectorXd x, command;
};

std::vector<Probe> probes(const model::Plant& plant) {
  std::mt19937 random(2);
  const auto draw = [&](double size) { return std::uniform_real_distribution<double>(-size, size)(random); };
  std::vector<Probe> all(5);
  for (Probe& probe : all) {
    probe.x.resize(plant.states());
    probe.command.resize(plant.motors());
    for (Eigen::Index i = 0; i < probe.x.size(); ++i) {
      probe.x[i] = draw(i < plant.positions() ? 2.0 : 6.0);
    }
    for (double& command : probe.command) {
      command = draw(3.0);
    }
  }
  return all;
}

void expect_same(model::Plant& bare, model::Plant& nested, const std::string& label) {
  ASSERT_EQ(nested.states(), bare.states()) << label;
  ASSERT_EQ(nested.positions(), bare.positions()) << label;
  for (int m = 0; m < bare.motors(); ++m) {
    EXPECT_EQ(nested.delay(m), bare.delay(m)) << label;
  }
  for (const Probe& probe : probes(bare)) {
    Eigen::VectorXd expected(bare.states());
    Eigen::VectorXd found(bare.states());
    bare.rate(probe.x.data(), probe.command.data(), expected.data());
    nested.rate(probe.x.data(), probe.command.data(), found.data());
    EXPECT_LE((found - expected).norm(), kRelative * expected.norm()) << label;
    Eigen::VectorXd y(bare.sensors());
    Eigen::VectorXd z(bare.sensors());
    bare.outputs(probe.x.data(), y.data());
    nested.outputs(probe.x.data(), z.data());
    EXPECT_LE((z - y).norm(), kRelative * y.norm()) << label;
  }
}

/// Null values, the choices (sides, smoothing) as a diagnosis would make them.
effects::Values null_with_choices(const effects::Law& law) {
  effects::Values values = law.null_values();
  const effects::Values start = law.starts({}).front();
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (law.declaration().parameters[p].structural) {
      values[p] = start[p];
    }
  }
  return values;
}

TEST(Null, EveryEffectAtEveryPlaceLeavesTheBareModel) {
  const model::Model model = leg_bench();
  model::Plant bare(model, {});
  int tried = 0;
  const effects::Catalogue catalogue = effects::Catalogue::all();
  for (const auto& law : catalogue.laws()) {
    if (law->sits_at(effects::Place::base) || law->sits_at(effects::Place::contact_switch) ||
        dynamic_cast<const effects::InertialSensorLaw*>(law.get()) != nullptr) {
      continue;  // the bench has none: tests/oracles/boom_test.cpp,
                 // tests/identify/predict/contact_timing_test.cpp, tests/model/inertial_error_test.cpp
    }
    int places = 0;
    for (const effects::Place place : law->declaration().places) {
      for (const std::string& at : model::places_of(model, *law, place)) {
        const std::string label = law->declaration().name + " at " + at;
        for (const effects::Values& values : {law->null_values(), null_with_choices(*law)}) {
          ASSERT_TRUE(law->is_null(values.data())) << label;
          model::Plant nested(with_effect(model, law, at, values), {});
          expect_same(bare, nested, label);
          ++tried;
        }
        ++places;
      }
    }
    EXPECT_GT(places, 0) << law->declaration().name << " has no place on the leg bench";
  }
  EXPECT_GT(tried, 100);
}

TEST(Null, AllEffectsTogetherLeaveTheBareModel) {
  const model::Model model = leg_bench();
  model::Model full = model;
  const effects::Catalogue catalogue = effects::Catalogue::all();
  for (const auto& law : catalogue.laws()) {
    for (const effects::Place place : law->declaration().places) {
      for (const std::string& at : model::places_of(model, *law, place)) {
        full = with_effect(full, law, at, law->null_values());
      }
    }
  }
  model::Plant bare(model, {});
  model::Plant nested(full, {});
  expect_same(bare, nested, "all effects");
}

TEST(Null, NotNullDoesChangeTheModel) {
  const model::Model model = leg_bench();
  model::Plant bare(model, {});
  const Probe probe = probes(bare).front();
  Eigen::VectorXd before(bare.states());
  Eigen::VectorXd after(bare.states());
  bare.rate(probe.x.data(), probe.command.data(), before.data());
  model::Plant changed(with_effect(model, "coulomb", "mLA", {0.1, 0.01}), {});
  changed.rate(probe.x.data(), probe.command.data(), after.data());
  EXPECT_GT((after - before).norm(), 1e-3 * before.norm());
}

}  // namespace
}  // namespace plumbline::limits
