// What is searched of a candidate.
#include "validation/identify/diagnose/candidates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/identify/diagnose/bench.h"
#include "tests/identify/standard/double_pendulum.h"

namespace plumbline::validation {
namespace {

std::vector<std::string> searched(const std::string& law, const std::string& place) {
  const Data data = bench_twins({}).thinned(1);
  const Stage stage = as_given(bench(), data);
  PredictorPool pool(stage.model, data);
  std::vector<std::string> labels;
  for (const Candidate& candidate : list_candidates(pool, some_laws({law}), {}, stage.estimate)) {
    if (candidate.at == place) {
      model::Model model = stage.model;
      model.effects.push_back(make_use(candidate, candidate.law->typical(candidate.scales)));
      const auto added = static_cast<int>(model.effects.size()) - 1;
      for (const FreeParameter& one : searched_parameters_of(model, candidate, added)) {
        labels.push_back(one.label);
      }
    }
  }
  return labels;
}

// The leg moves in the plane of x and z.
TEST(Candidates, AreNotSearchedAcrossThePlaneOfTheRobot) {
  EXPECT_THAT(searched("com_shift", "shin"), testing::ElementsAre("com_shift@shin:x", "com_shift@shin:z"));
}

// Of a spring without stiffness the rest does nothing, of one with stiffness it does.
TEST(Candidates, AreSearchedInAllThatMatters) {
  EXPECT_THAT(searched("spring", "shin"), testing::ElementsAre("spring@shin:stiffness", "spring@shin:rest"));
}

// A load on the axis turns with its rotor, and by itself has no inertia.
TEST(Candidates, DoNotStretchWhatLeavesNoInertia) {
  model::Model model = pendulums::stated();
  model::Body& lower = model.skeleton.bodies[static_cast<std::size_t>(model.body_index("lower"))];
  lower.com.setZero();
  lower.inertia.setZero();
  const Data data = pendulums::data({}).thinned(1);
  PredictorPool pool(model, data);
  std::vector<std::string> places;
  for (const Candidate& one :
       list_candidates(pool, some_laws({"cable_stretch"}), {}, estimate_states(pool))) {
    places.push_back(one.at);
  }
  EXPECT_THAT(places, testing::ElementsAre("shoulder"));
}

}  // namespace
}  // namespace plumbline::validation
