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

// One round only: all four cables take a quarter of an hour.
TEST(DiagnosedHops, NameTheStretchOfACableOnTheirBeginnings) {
  const model::Model machine = mabel("mabel_planar.yaml");
  const Data data(
      {recorded_hops(machine, {}, Role::train), recorded_hops(machine, {0.06, -0.45, 0.0}, Role::held_out)},
      {});
  DiagnoseOptions options;
  options.most_effects = 1;
  const Diagnosis diagnosis = diagnose(mabel("mabel_planar_rigid.yaml"), some_laws(), data, options,
                                       [](const std::string& /*what*/, double /*fraction*/) {});
  ASSERT_EQ(diagnosis.accepted.size(), 1U);
  EXPECT_EQ(diagnosis.accepted.front().effect, "cable_stretch");
  EXPECT_LT(diagnosis.accepted.front().held_out_after, 0.6 * diagnosis.accepted.front().held_out_before);
  EXPECT_EQ(diagnosis.verdict, Verdict::unexplained);
  EXPECT_LT(diagnosis.ladder.front().part, 0.2);
}

}  // namespace
}  // namespace plumbline::validation
