#include "tests/identify/diagnose/bench.h"

#include "simulator/model/robot_file.h"
#include "tests/identify/predict/hopper.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

Data twins_of(const model::Model& bare, const std::string& folder, const std::vector<std::string>& names,
              const std::vector<std::string>& hidden) {
  model::Model robot = bare;
  for (const std::string& one : hidden) {
    robot.effects.push_back(parse_effect(one, bare, effects::Catalogue::all()));
  }
  std::vector<Trial> trials;
  for (const std::string& name : names) {
    trials.push_back(twin(robot, read_experiment(folder + "/" + name + ".yaml", bare), {}));
    trials.back().name = trials.back().file = name;
  }
  return Data(std::move(trials), {});
}

}  // namespace

model::Model bench() { return model::read_model("robots/mabel/leg_bench.yaml", effects::Catalogue::all()); }

Data bench_twins(const std::vector<std::string>& hidden) {
  return twins_of(bench(), "robots/mabel/experiments", {"siso_mLA", "siso_mLS", "mimo"}, hidden);
}

model::Model pendulum_drive() {
  return model::read_model("tests/robots/pendulum/model.yaml", effects::Catalogue::all());
}

Data pendulum_twins(const std::vector<std::string>& hidden) {
  return twins_of(pendulum_drive(), "tests/robots/pendulum/experiments", {"chirp", "steps", "multisine"},
                  hidden);
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
