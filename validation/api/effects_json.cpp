#include "validation/api/effects_json.h"

#include "simulator/effects/documentation.h"
#include "simulator/model/known_effects.h"
#include "simulator/trace/error.h"
#include "validation/report/json_number.h"

namespace plumbline::api {
namespace {

using validation::json_number;

nlohmann::json to_json(const effects::Parameter& parameter) {
  return {{"name", parameter.name},
          {"meaning", parameter.meaning},
          {"rotary_unit", effects::unit_at(parameter.unit, true)},
          {"linear_unit", effects::unit_at(parameter.unit, false)},
          {"null_value", json_number(parameter.null_value)},
          {"lower", json_number(parameter.lower)},
          {"upper", json_number(parameter.upper)},
          {"scale", to_string(parameter.scale)},
          {"structural", parameter.structural}};
}

nlohmann::json to_json(const effects::Declaration& law) {
  nlohmann::json json{{"name", law.name},
                      {"summary", law.summary},
                      {"equation", law.equation},
                      {"source", law.source},
                      {"states", law.states},
                      {"power_note", law.power_note},
                      {"places", nlohmann::json::array()},
                      {"parameters", nlohmann::json::array()}};
  for (const effects::Place place : law.places) {
    json["places"].push_back(effects::to_string(place));
  }
  for (const effects::Parameter& parameter : law.parameters) {
    json["parameters"].push_back(to_json(parameter));
  }
  return json;
}

}  // namespace

std::string to_string(effects::Scale scale) {
  switch (scale) {
    case effects::Scale::linear:
      return "linear";
    case effects::Scale::logarithm:
      return "logarithm";
    case effects::Scale::reciprocal:
      break;
  }
  return "reciprocal";
}

effects::Catalogue named_effects(const std::string& name) {
  effects::Catalogue catalogue = model::known_effects();
  if (name.empty()) {
    return catalogue;
  }
  const auto law = catalogue.find(name);
  if (law == nullptr) {
    std::vector<std::string> known;
    for (const auto& one : catalogue.laws()) {
      known.push_back(one->declaration().name);
    }
    throw InputError({"", 0, "effects"}, "\"" + name + "\"",
                     "an effect of the catalogue" + nearest_names(name, known));
  }
  return effects::Catalogue({law});
}

nlohmann::json effects_json(const effects::Catalogue& catalogue) {
  nlohmann::json json{{"effects", nlohmann::json::array()}};
  for (const auto& law : catalogue.laws()) {
    json["effects"].push_back(to_json(law->declaration()));
  }
  return json;
}

}  // namespace plumbline::api
