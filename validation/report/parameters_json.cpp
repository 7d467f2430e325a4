#include "validation/report/parameters_json.h"

#include <cmath>

#include "validation/identify/fit/fit.h"
#include "validation/identify/predict/deviations.h"
#include "validation/report/json_number.h"

namespace plumbline::validation {
namespace {

using nlohmann::json;

/// The value in the given model, or null for an effect that it does not have.
const model::Quantity* given_quantity(const model::Model& given, const FreeParameter& parameter) {
  const auto effect = static_cast<std::size_t>(parameter.id.effect);
  return effect < given.effects.size()
             ? &given.effects[effect].values[static_cast<std::size_t>(parameter.id.parameter)]
             : nullptr;
}

json parameter_json(const FreeParameter& parameter, const FittedParameter& fitted,
                    const model::Quantity* given) {
  json out{{"label", fitted.label},
           {"unit", fitted.unit},
           {"value", json_number(fitted.after)},
           {"standard_deviation", json_number(fitted.deviation)},
           {"interval", {json_number(fitted.lower), json_number(fitted.upper)}},
           {"given", nullptr},
           {"known", nullptr},
           {"source", "found in these trials"},
           {"assumed", false},
           {"doubts", json::array()}};
  if (given == nullptr && std::isfinite(parameter.deviation)) {
    out["source"] = "stated in the model, with this uncertainty";
  }
  if (given != nullptr) {
    out["given"] = json_number(given->value);
    out["source"] = given->source;
    out["assumed"] = given->assumed;
  }
  if (std::isfinite(parameter.deviation)) {
    out["known"] = {{"mean", json_number(parameter.mean)}, {"standard_deviation", parameter.deviation}};
  }
  for (const Doubt& doubt : fitted.doubts) {
    out["doubts"].push_back({{"kind", doubt.kind}, {"text", doubt.text}});
  }
  return out;
}

json matrix_json(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    json row = json::array();
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      row.push_back(std::round(1000.0 * matrix(r, c)) / 1000.0);
    }
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

json parameters_json(const model::Model& given, const Stage& stage, const Precision& precision,
                     const Data& data) {
  const FitOptions options;
  json out{{"windows", 0},
           {"confidence", options.confidence},
           {"parameters", json::array()},
           {"correlation", nullptr}};
  const std::vector<int> windows = data.windows_of(Role::train);
  if (stage.parameters.empty() || windows.empty()) {
    return out;
  }
  FitNumbers numbers;
  numbers.before = stage.estimate.theta;
  numbers.after = stage.estimate.theta;
  numbers.precision = precision;
  if (precision.deviations.size() != numbers.after.size()) {
    PredictorPool pool(stage.model, data);
    numbers.precision = precision_of(pool, windows, stage.parameters, stage.estimate);
  }
  const std::vector<FittedParameter> judged = judge(stage.parameters, numbers, options);
  for (std::size_t p = 0; p < judged.size(); ++p) {
    out["parameters"].push_back(
        parameter_json(stage.parameters[p], judged[p], given_quantity(given, stage.parameters[p])));
  }
  out["windows"] = windows.size();
  out["correlation"] = matrix_json(numbers.precision.correlation);
  return out;
}

}  // namespace plumbline::validation
