#include "validation/identify/standard/result.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::validation {
namespace {

nlohmann::json number(double value) {
  return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json();
}

nlohmann::json json_of(const Scores& scores, const Data& data) {
  return {{"train", number(scores.train)},
          {"held_out", data.has(Role::held_out) ? number(scores.held_out) : nlohmann::json()},
          {"test", data.tests.empty() ? nlohmann::json() : number(scores.test)}};
}

nlohmann::json json_of(const FreeValue& value) {
  return {{"label", value.label},
          {"unit", value.unit},
          {"stated", number(value.stated)},
          {"spread", number(value.spread)},
          {"value", number(value.value)},
          {"standard_deviation", number(value.deviation)},
          {"lower", number(value.lower)},
          {"upper", number(value.upper)},
          {"seen", value.seen},
          {"at_limit", value.at_limit}};
}

std::string source_of(const Data& data) {
  std::string text;
  for (const Trial& trial : data.trials) {
    if (trial.role == Role::train) {
      text += (text.empty() ? "standard identification on " : ", ") + trial.name;
    }
  }
  return text;
}

/// Of the values of one effect, NaN where they were not identified.
effects::Values deviations_of(const StandardFit& fit, std::size_t effect, std::size_t count) {
  effects::Values deviations(count, std::numeric_limits<double>::quiet_NaN());
  for (const FreeValue& value : fit.free.values) {
    if (value.id.effect == static_cast<int>(effect) && value.seen) {
      deviations[static_cast<std::size_t>(value.id.parameter)] = value.deviation;
    }
  }
  return deviations;
}

}  // namespace

nlohmann::json to_json(const StandardFit& fit, const Data& data) {
  nlohmann::json json{{"model", fit.free.model.file},
                      {"before", json_of(fit.before, data)},
                      {"after", json_of(fit.after, data)},
                      {"cutoff", fit.cutoff},
                      {"samples", fit.samples},
                      {"at_limits", fit.at_limits()},
                      {"unseen", fit.unseen()},
                      {"torques", nlohmann::json::array()},
                      {"values", nlohmann::json::array()}};
  for (const TorqueError& torque : fit.torques) {
    json["torques"].push_back({{"motor", torque.motor},
                               {"unit", torque.unit},
                               {"recorded", number(torque.recorded)},
                               {"before", number(torque.before)},
                               {"after", number(torque.after)}});
  }
  for (const FreeValue& value : fit.free.values) {
    json["values"].push_back(json_of(value));
  }
  return json;
}

void save(const StandardFit& fit, const Data& data, const std::string& file) {
  const std::string source = source_of(data);
  const model::Model found = identified(fit.free);
  std::vector<model::AddedEffect> added;
  for (std::size_t e = fit.free.own; e < found.effects.size(); ++e) {
    const model::EffectUse& use = found.effects[e];
    const effects::Values numbers = use.numbers();
    if (!use.law->is_null(numbers.data())) {
      added.push_back(
          {use.law->declaration().name, use.at, numbers, false, deviations_of(fit, e, numbers.size())});
    }
  }
  std::vector<model::NewValue> values;
  for (const FreeValue& value : fit.free.values) {
    if (value.id.effect < static_cast<int>(fit.free.own) && value.seen) {
      values.push_back({value.label, value.value, value.deviation, value.unit, source});
    }
  }
  model::Correlations together{{}, fit.free.correlation};
  for (const FreeValue& value : fit.free.values) {
    together.of.push_back(value.label);
  }
  model::write_overlay(file, found.file, added, values, source, model::known_effects(),
                       together.matrix.size() > 0 ? together : model::Correlations{});
}

}  // namespace plumbline::validation
