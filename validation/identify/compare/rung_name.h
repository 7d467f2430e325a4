// How a model is called on a ladder.
#pragma once

#include <set>
#include <string>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// Names of a model's effects ("coulomb@drive"). Empty: no model is known yet.
using EffectNames = std::set<std::string>;

EffectNames effect_names(const model::Model& model);

/// The model file's name, and the effects that it has and the model below it (`known`) has not:
/// "overlay.yaml + coulomb@drive"; of more than three the first two and how many more.
std::string rung_name(const model::Model& model, const EffectNames& known);

}  // namespace plumbline::validation
