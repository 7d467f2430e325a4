// Links that swing freely: nothing drives them, and friction shows all the same.
#include <gtest/gtest.h>

#include "simulator/model/robot_file.h"
#include "tests/identify/diagnose/bench.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

model::Model links_without_motors() {
  model::Model links =
      model::read_model("tests/robots/double_pendulum/model.yaml", effects::Catalogue::all());
  links.motors.clear();
  links.ratios.clear();
  return links;
}

Trial let_go(const model::Model& truth, const std::string& role, const std::string& start) {
  const Experiment experiment = parse_experiment(
      "plumbline: experiment/1\ntitle: let go\nrole: " + role +
          "\nduration: {value: 4, unit: s}\nsample_period: {value: 0.004, unit: s}\nstart: {" + start + "}\n",
      "let_go", truth);
  Trial trial = twin(truth, experiment, {});
  trial.name = trial.file = role;
  return trial;
}

TEST(Undriven, FrictionOfLinksThatSwingFreelyIsNamed) {
  const model::Model links = links_without_motors();
  model::Model truth = links;
  truth.effects.push_back(parse_effect("viscous@elbow:damping=0.004", links, effects::Catalogue::all()));
  const Data data(
      {let_go(truth, "train", "shoulder: {value: 60, unit: deg}, elbow: {value: 40, unit: deg}"),
       let_go(truth, "held-out", "shoulder: {value: 20, unit: deg}, elbow: {value: -80, unit: deg}")},
      {});
  const Diagnosis d =
      diagnose(links, some_laws({"viscous", "coulomb", "spring", "encoder_scale"}), data, {}, silent);
  EXPECT_EQ(d.verdict, Verdict::missing);
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.accepted[0].label(), "viscous@elbow");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 0.004, 1e-4);
}

}  // namespace
}  // namespace plumbline::validation
