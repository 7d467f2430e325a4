// One effect more on a model, with values to begin a fit from.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::api {

struct Addition {
  std::string effect, at;
  std::vector<std::string> set;  ///< "parameter=value", SI units of the place
};

/// The effect with the values that are set, and for the others the start in the middle of the law's grid (the
/// null values for most laws), by the scales of the train trial's motion where there is one. Throws
/// InputError with the nearest names when effect, place or parameter is unknown, and when a value is outside
/// its bounds.
model::EffectUse added_effect(const Addition& addition, const model::Model& model,
                              const std::optional<validation::Trial>& trial);

/// From "EFFECT" with its place beside it, or "EFFECT@PLACE:PARAMETER=VALUE,...". Throws InputError where
/// both or neither name the place.
Addition addition_of(const std::string& text, const std::string& at, const std::vector<std::string>& set);

bool is_set(const Addition& addition, const std::string& parameter);

/// docs/formats/json.md, `add`, but for the name of the file.
nlohmann::json to_json(const model::EffectUse& use, const model::Model& model, const Addition& addition);

/// An overlay on the model's file with all of them.
void save(const std::vector<model::EffectUse>& uses, const model::Model& model, const std::string& file);

}  // namespace plumbline::api
