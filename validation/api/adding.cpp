#include "validation/api/adding.h"

#include <algorithm>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/identify/fit/scales.h"
#include "validation/identify/twin/twin.h"
#include "validation/report/json_number.h"
#include "validation/report/model_json.h"

namespace plumbline::api {
namespace {

effects::Scales scales_for(const model::Model& model, const model::EffectUse& use,
                           const std::optional<validation::Trial>& trial) {
  if (trial && trial->role == validation::Role::train) {
    const validation::Data data({*trial}, {});
    return validation::scales_at(model, use.law, use.at, data);
  }
  return validation::scales_at(model, *use.law, use.at);
}

}  // namespace

bool is_set(const Addition& addition, const std::string& parameter) {
  return std::any_of(addition.set.begin(), addition.set.end(), [&](const std::string& setting) {
    return setting.compare(0, parameter.size() + 1, parameter + "=") == 0;
  });
}

Addition addition_of(const std::string& text, const std::string& at, const std::vector<std::string>& set) {
  const std::size_t sign = text.find('@');
  if ((sign == std::string::npos) == at.empty()) {
    throw InputError({"", 0, text}, at.empty() ? "an effect without a place" : "two places",
                     "EFFECT@PLACE, or one EFFECT and --at");
  }
  if (sign == std::string::npos) {
    return {text, at, set};
  }
  const std::size_t colon = text.find(':', sign);
  Addition addition{text.substr(0, sign), text.substr(sign + 1, colon - sign - 1), set};
  for (std::size_t from = colon; from != std::string::npos;) {
    const std::size_t to = text.find(',', from + 1);
    addition.set.push_back(text.substr(from + 1, to - from - 1));
    from = to;
  }
  return addition;
}

model::EffectUse added_effect(const Addition& addition, const model::Model& model,
                              const std::optional<validation::Trial>& trial) {
  std::string text = addition.effect + "@" + addition.at + ":";
  for (std::size_t i = 0; i < addition.set.size(); ++i) {
    text += (i == 0 ? "" : ",") + addition.set[i];
  }
  model::EffectUse use = validation::parse_effect(text, model, model::known_effects());
  const std::vector<effects::Values> starts = use.law->starts(scales_for(model, use, trial));
  // Of two in the middle the first: starts go from what changes little to what changes much, and under too
  // much a model no longer moves as the trials do, so that no fit begins (a quadruped under five trunks).
  const effects::Values& start = starts[(starts.size() - 1) / 2];
  for (std::size_t p = 0; p < use.values.size(); ++p) {
    const effects::Parameter& parameter = use.law->declaration().parameters[p];
    if (!is_set(addition, parameter.name)) {
      use.values[p].value = std::clamp(start[p], parameter.lower, parameter.upper);
    }
  }
  return use;
}

nlohmann::json to_json(const model::EffectUse& use, const model::Model& model, const Addition& addition) {
  nlohmann::json json{{"base", model.file},
                      {"effect", addition.effect},
                      {"at", addition.at},
                      {"changes_nothing", use.law->is_null(use.numbers().data())},
                      {"values", nlohmann::json::array()}};
  for (std::size_t p = 0; p < use.values.size(); ++p) {
    const effects::Parameter& parameter = use.law->declaration().parameters[p];
    json["values"].push_back({{"name", parameter.name},
                              {"value", validation::json_number(use.values[p].value)},
                              {"unit", validation::unit_of(model, use, p)},
                              {"set", is_set(addition, parameter.name)},
                              {"structural", parameter.structural}});
  }
  return json;
}

void save(const std::vector<model::EffectUse>& uses, const model::Model& model, const std::string& file) {
  std::vector<model::AddedEffect> added;
  std::string names;
  for (const model::EffectUse& use : uses) {
    added.push_back({use.law->declaration().name, use.at, use.numbers()});
    names += (names.empty() ? "" : ", ") + use.label();
  }
  model::write_overlay(file, model.file, added, {}, names + ", added with start values",
                       model::known_effects());
}

}  // namespace plumbline::api
