#include "validation/api/fitting.h"

#include <utility>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/whole_fit.h"
#include "validation/report/json_number.h"

namespace plumbline::api {
namespace {

using validation::Doubt;
using validation::Fit;
using validation::FittedParameter;
using validation::json_number;
using validation::Role;

nlohmann::json to_json(const FittedParameter& parameter) {
  nlohmann::json json{{"label", parameter.label},
                      {"unit", parameter.unit},
                      {"before", json_number(parameter.before)},
                      {"after", json_number(parameter.after)},
                      {"standard_deviation", json_number(parameter.deviation)},
                      {"degrees_of_freedom", json_number(parameter.degrees_of_freedom)},
                      {"interval", {json_number(parameter.lower), json_number(parameter.upper)}},
                      {"partner", parameter.partner},
                      {"correlation", parameter.correlation},
                      {"doubts", nlohmann::json::array()}};
  for (const Doubt& doubt : parameter.doubts) {
    json["doubts"].push_back({{"kind", doubt.kind}, {"text", doubt.text}});
  }
  return json;
}

nlohmann::json to_json(const validation::Scores& scores, const Loaded& loaded) {
  return {{"train", scores.train},
          {"held_out", score_or_null<nlohmann::json>(loaded, Role::held_out, scores.held_out)},
          {"test", scores.test > 0.0 ? nlohmann::json(scores.test) : nlohmann::json()}};
}

/// "fit on chirp, steps": the trials that were fitted.
std::string source_text(const validation::Data& data) {
  std::string text;
  for (const validation::Trial& trial : data.trials) {
    if (trial.role == Role::train) {
      text += (text.empty() ? "fit on " : ", ") + trial.name;
    }
  }
  return text;
}

}  // namespace

Fit fit(const Loaded& loaded, const std::vector<std::string>& patterns, const validation::FitOptions& options,
        const validation::Progress& progress) {
  std::vector<validation::FreeParameter> free =
      validation::matching(validation::free_parameters(loaded.model), patterns);
  return options.whole ? validation::fit_whole(loaded.model, *loaded.data, std::move(free), options, progress)
                       : validation::fit(loaded.model, *loaded.data, std::move(free), options, progress);
}

nlohmann::json to_json(const Fit& fit, const Loaded& loaded, const validation::FitOptions& options) {
  nlohmann::json json{{"model", loaded.model.file},           {"before", to_json(fit.before, loaded)},
                      {"after", to_json(fit.after, loaded)},  {"windows", fit.windows},
                      {"confidence", options.confidence},     {"iterations", fit.iterations},
                      {"converged", fit.converged},           {"whole", fit.whole},
                      {"parameters", nlohmann::json::array()}};
  for (const FittedParameter& parameter : fit.parameters) {
    json["parameters"].push_back(to_json(parameter));
  }
  return json;
}

void save(const Fit& fit, const Loaded& loaded, const std::string& file) {
  const std::string source = source_text(*loaded.data);
  std::vector<model::NewValue> values;
  for (const FittedParameter& parameter : fit.parameters) {
    if (parameter.seen()) {
      values.push_back({parameter.label, parameter.after, parameter.deviation, parameter.unit, source});
    }
  }
  model::write_overlay(file, loaded.model.file, {}, values, "values " + source, model::known_effects(),
                       fit.together);
}

}  // namespace plumbline::api
