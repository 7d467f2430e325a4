// A rod of a closed loop is a place like any other.
#include <gtest/gtest.h>

#include "simulator/model/robot_file.h"
#include "tests/identify/diagnose/bench.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

// Linear laws at the joints tell nothing of a rod: without being tried there it would never be found.
TEST(Rod, IsNamedWhereItStretches) {
  const model::Model leg = model::read_model("tests/robots/pushrod/model.yaml", effects::Catalogue::all());
  model::Model truth = leg;
  truth.effects.push_back(
      parse_effect("cable_stretch@pushrod:stiffness=5000,damping=5", leg, effects::Catalogue::all()));
  std::vector<Trial> trials;
  for (const std::string name : {"chirp", "steps", "swing"}) {
    trials.push_back(
        twin(truth, read_experiment("tests/robots/four_bar/experiments/" + name + ".yaml", leg), {}));
    trials.back().name = trials.back().file = name;
  }
  const Diagnosis d =
      diagnose(leg, some_laws({"cable_stretch", "spring", "viscous", "torque_constant_error"}),
               Data(std::move(trials), {}).thinned(4), {}, silent);
  ASSERT_EQ(d.accepted.size(), 1U);
  EXPECT_EQ(d.verdict, Verdict::missing);
  EXPECT_EQ(d.accepted[0].label(), "cable_stretch@pushrod");
  EXPECT_NEAR(d.accepted[0].parameters[0].value, 5000.0, 50.0);
  EXPECT_LT(d.accepted[0].held_out_after, 1.05);
}

}  // namespace
}  // namespace plumbline::validation
