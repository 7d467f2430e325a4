// The hopper and its trials, made once for a test program.
#pragma once

#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation::test {

inline model::Model hopper() {
  return model::read_model(std::string(PLUMBLINE_ROOT) + "/robots/hopper/hopper.yaml",
                           model::known_effects());
}

inline Trial hopper_trial(const model::Model& model, const std::string& experiment) {
  const std::string file = std::string(PLUMBLINE_ROOT) + "/robots/hopper/experiments/" + experiment + ".yaml";
  Trial trial = twin(model, read_experiment(file, model), {});
  trial.file = trial.name = experiment;
  return trial;
}

}  // namespace plumbline::validation::test
