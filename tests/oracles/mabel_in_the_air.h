// robots/mabel without its ground.
#pragma once

#include <algorithm>
#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::oracles {

inline model::Model mabel_in_the_air(const std::string& file) {
  model::Model model = model::read_model(PLUMBLINE_ROOT "/robots/mabel/" + file, model::known_effects());
  const auto of_the_ground = [](const model::EffectUse& use) {
    return use.law->sits_at(effects::Place::foot);
  };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), of_the_ground),
                      model.effects.end());
  return model;
}

}  // namespace plumbline::oracles
