// What a diagnosis saves of its values, so that the next one does not take them for exact.
#include "validation/identify/diagnose/found_values.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::validation {
namespace {

constexpr const char* kModel = PLUMBLINE_ROOT "/tests/robots/pendulum/model.yaml";

/// Coulomb friction was found at the drive; its level is a parameter of the final stage.
Diagnosis with_friction() {
  Diagnosis diagnosis;
  Stage& stage = diagnosis.final_stage;
  stage.model = model::read_model(kModel, model::known_effects());
  model::EffectUse use{model::known_effects().find("coulomb"), "drive", {}, 0};
  use.values.resize(2);
  stage.model.effects.push_back(use);
  FreeParameter level;
  level.id = {static_cast<int>(stage.model.effects.size()) - 1, 0};
  stage.parameters.push_back(level);
  stage.estimate.theta = Eigen::VectorXd::Constant(1, 1e-4);
  Finding finding;
  finding.effect = "coulomb";
  finding.at = "drive";
  finding.parameters.push_back({"level", "N m", 1e-4, 3e-6, false});
  diagnosis.accepted.push_back(finding);
  return diagnosis;
}

TEST(FoundValues, AreAsSureAsTheFindingSays) {
  const Diagnosis diagnosis = with_friction();
  const effects::Values deviations =
      found_deviations(diagnosis, diagnosis.final_stage.parameters[0].id.effect);
  ASSERT_EQ(deviations.size(), 2U);
  EXPECT_EQ(deviations[0], 3e-6);
  EXPECT_TRUE(std::isnan(deviations[1]));  // the smoothing speed was not estimated
}

TEST(FoundValues, AreAsSureAsTheCostSaysWhereItWasAsked) {
  Diagnosis diagnosis = with_friction();
  diagnosis.precision.deviations = Eigen::VectorXd::Constant(1, 5e-6);
  EXPECT_EQ(found_deviation(diagnosis, diagnosis.final_stage.parameters[0].id), 5e-6);
}

TEST(FoundValues, ASavedEffectStatesTheUncertaintyOfWhatWasFound) {
  const std::string file = (std::filesystem::temp_directory_path() / "found_values_test.yaml").string();
  model::AddedEffect added{"coulomb", "drive", {1e-4, 0.01}, false, {3e-6, std::nan("")}};
  model::write_overlay(file, kModel, {added}, {}, "written by a test", model::known_effects());
  const model::Model read = model::read_model(file, model::known_effects());
  const model::EffectUse& use = read.effects.back();
  EXPECT_EQ(use.values[0].uncertainty, 3e-6);
  EXPECT_FALSE(use.values[0].assumed);
  EXPECT_TRUE(use.values[1].assumed);
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace plumbline::validation
