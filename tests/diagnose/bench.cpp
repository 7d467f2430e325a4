#include "tests/diagnose/bench.h"

#include "simulator/model/robot_file.h"
#include "tests/predict/hopper.h"
#include "validation/twin/twin.h"

namespace plumbline::validation {

model::Model bench() { return model::read_model("robots/mabel/leg_bench.yaml", effects::Catalogue::all()); }

Data bench_twins(const std::vector<std::string>& hidden) {
  const model::Model bare = bench();
  model::Model robot = bare;
  for (const std::string& one : hidden) {
    robot.effects.push_back(parse_effect(one, bare, effects::Catalogue::all()));
  }
  std::vector<Trial> trials;
  for (const std::string name : {"siso_mLA", "siso_mLS", "mimo"}) {
    trials.push_back(twin(robot, read_experiment("robots/mabel/experiments/" + name + ".yaml", bare), {}));
    trials.back().name = trials.back().file = name;
  }
  return Data(std::move(trials), {});
}

Data hopper_twins(const std::string& hidden) {
  model::Model truth = test::hopper();
  truth.effects.push_back(parse_effect(hidden, truth, effects::Catalogue::all()));
  return Data({test::hopper_trial(truth, "bounce"), test::hopper_trial(truth, "steps")}, {});
}

effects::Catalogue some_laws(const std::set<std::string>& names) {
  const effects::Catalogue all = effects::Catalogue::all();
  effects::Catalogue catalogue = all;
  for (const auto& law : all.laws()) {
    if (names.count(law->declaration().name) == 0) {
      catalogue = catalogue.without(law->declaration().name);
    }
  }
  return catalogue;
}

Stage as_given(const model::Model& model, const Data& data) {
  PredictorPool pool(model, data);
  return {model, {}, estimate_states(pool)};
}

}  // namespace plumbline::validation
