#include "validation/api/twins.h"

#include "simulator/model/known_effects.h"

namespace plumbline::api {

model::Model with_effects(const model::Model& model, const std::vector<std::string>& texts) {
  const effects::Catalogue catalogue = model::known_effects();
  model::Model robot = model;
  for (const std::string& text : texts) {
    robot.effects.push_back(validation::parse_effect(text, robot, catalogue));
  }
  return robot;
}

validation::Trial twin(const model::Model& model, const model::Model& robot, const std::string& file,
                       const validation::TwinOptions& options) {
  return validation::twin(robot, validation::read_experiment(file, model), options);
}

}  // namespace plumbline::api
