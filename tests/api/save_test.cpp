// What a diagnosis saves can always be read again, whatever was named beside what the model left open.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/api/changed_model.h"
#include "validation/api/diagnosing.h"

namespace plumbline::api {
namespace {

constexpr const char* kModel = PLUMBLINE_ROOT "/tests/robots/pendulum/model.yaml";

model::Model given() { return model::read_model(kModel, model::known_effects()); }

void use(const std::string& law, const std::string& at, const effects::Values& values,
         validation::Stage& stage) {
  model::EffectUse one{model::known_effects().find(law), at, {}, 0};
  for (const double value : values) {
    model::Quantity quantity;
    quantity.value = value;
    one.values.push_back(quantity);
  }
  stage.model.effects.push_back(one);
}

/// Reads what is saved of a diagnosis that ended with these two effects of one kind at one place.
model::Model saved(const std::string& law, const std::string& at, const effects::Values& open,
                   const effects::Values& named) {
  validation::Diagnosis diagnosis;
  diagnosis.final_stage.model = given();
  use(law, at, open, diagnosis.final_stage);
  use(law, at, named, diagnosis.final_stage);
  const std::string file = testing::TempDir() + "found_" + law + ".yaml";
  save(diagnosis, given(), file);
  model::Model model = model::read_model(file, model::known_effects());
  std::filesystem::remove(file);
  return model;
}

TEST(SavedDiagnosis, TakesANamedInertiaIntoTheNumberThatWasOpen) {
  const model::Model model = saved("rotor_inertia", "drive", {2e-6}, {6e-5});
  ASSERT_EQ(model.effects.size(), given().effects.size() + 1);
  EXPECT_NEAR(model.effects.back().values.front().value, 6.2e-5, 1e-12);
}

TEST(SavedDiagnosis, KeepsTwoEffectsThatAreNoSum) {
  const model::Model model = saved("viscous", "drive", {1e-5}, {2e-5});
  EXPECT_EQ(model.effects.size(), given().effects.size() + 2);
}

// A number that was open and then held where it came to is no parameter of the last stage: the error rests
// on it all the same.
TEST(SavedDiagnosis, KeepsWhereTheModelsOwnNumbersCameTo) {
  validation::Diagnosis diagnosis;
  diagnosis.final_stage.model = given();
  ASSERT_EQ(given().effects.front().label(), "viscous at drive");
  diagnosis.final_stage.model.effects.front().values.front().value *= 0.9;
  const std::string file = testing::TempDir() + "found_own.yaml";
  save(diagnosis, given(), file);
  const double saved = model::read_model(file, model::known_effects()).effects.front().values.front().value;
  EXPECT_DOUBLE_EQ(saved, 0.9 * given().effects.front().values.front().value);
  const ChangedModel changed = diagnosed(read_model(kModel), diagnosis);
  save(changed, file, "test");
  EXPECT_DOUBLE_EQ(model::read_model(file, model::known_effects()).effects.front().values.front().value,
                   saved);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace plumbline::api
