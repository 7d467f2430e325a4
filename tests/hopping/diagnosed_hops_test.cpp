// The story of MABEL's cables: a model without their stretch is diagnosed from a recorded run.
#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/diagnose/diagnose.h"
#include "validation/hopping/hop_run.h"
#include "validation/hopping/hopping_file.h"
#include "validation/hopping/recorded_trial.h"

namespace plumbline::validation {
namespace {

model::Model mabel(const std::string& name) {
  return model::read_model(PLUMBLINE_ROOT "/robots/mabel/" + name, model::known_effects());
}

/// Long enough that several windows tell what one leaves open.
Trial recorded_hops(const model::Model& model, const HopStart& start, Role role) {
  HopOptions options;
  options.hops = 6;
  options.trace = true;
  const controllers::HoppingConfig setup = read_hopping(PLUMBLINE_ROOT "/robots/mabel/hopping.yaml");
  Trial trial = recorded_trial(model, hop(model, setup, start, options).trace, 1);
  trial.role = role;
  return trial;
}

/// Few laws, so that it is quick.
effects::Catalogue some_laws() {
  std::vector<std::shared_ptr<const effects::Law>> laws;
  for (const char* name : {"cable_stretch", "viscous", "encoder_offset"}) {
    laws.push_back(model::known_effects().find(name));
  }
  return effects::Catalogue(laws);
}

double stiffness_of(const model::Model& model, const std::string& place) {
  for (const model::EffectUse& use : model.effects) {
    if (use.label() == "cable_stretch@" + place) {
      return use.values.front().value;
    }
  }
  return 0.0;
}

TEST(DiagnosedHops, NameTheStretchOfTheCables) {
  const model::Model machine = mabel("mabel_planar.yaml");
  const Data data(
      {recorded_hops(machine, {}, Role::train), recorded_hops(machine, {0.06, -0.45, 0.0}, Role::held_out)},
      {});
  const Diagnosis diagnosis = diagnose(mabel("mabel_planar_rigid.yaml"), some_laws(), data, {},
                                       [](const std::string& /*what*/, double /*fraction*/) {});
  EXPECT_EQ(diagnosis.verdict, Verdict::missing);
  EXPECT_EQ(diagnosis.accepted.size(), 4U);
  for (const Finding& finding : diagnosis.accepted) {
    EXPECT_EQ(finding.effect, "cable_stretch") << finding.at;
    const double stiffness = stiffness_of(machine, finding.at);
    EXPECT_NEAR(finding.parameters.front().value, stiffness, 0.05 * stiffness) << finding.at;
  }
  EXPECT_LT(diagnosis.ladder.front().part, 0.2);
  EXPECT_EQ(diagnosis.ladder.back().part, 1.0);
}

}  // namespace
}  // namespace plumbline::validation
