#include "validation/api/changed_model.h"

#include <algorithm>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/fit/free_parameters.h"

namespace plumbline::api {
namespace {

using validation::FreeParameter;

double& value_of(model::Model& model, const model::ParameterId& id) {
  return model.effects[static_cast<std::size_t>(id.effect)]
      .values[static_cast<std::size_t>(id.parameter)]
      .value;
}

/// Does the model have an effect of this kind at the same place before the one with this index?
bool has_one_before(const model::Model& model, std::size_t index) {
  const auto end = model.effects.begin() + static_cast<std::ptrdiff_t>(index);
  return std::any_of(model.effects.begin(), end, [&](const model::EffectUse& other) {
    return other.label() == model.effects[index].label();
  });
}

}  // namespace

double value_at(const model::Model& model, const model::ParameterId& id) {
  return model.effects[static_cast<std::size_t>(id.effect)]
      .values[static_cast<std::size_t>(id.parameter)]
      .value;
}

std::vector<FreeParameter> moved_from(const model::Model& given, const validation::Stage& found) {
  std::vector<FreeParameter> moved;
  for (const FreeParameter& parameter : validation::free_parameters(found.model)) {
    const auto is_this = [&](const FreeParameter& other) {
      return other.id.effect == parameter.id.effect && other.id.parameter == parameter.id.parameter;
    };
    const bool is_own = parameter.id.effect < static_cast<int>(given.effects.size());
    if (is_own && (value_at(given, parameter.id) != value_at(found.model, parameter.id) ||
                   std::any_of(found.parameters.begin(), found.parameters.end(), is_this))) {
      moved.push_back(parameter);
    }
  }
  return moved;
}

ChangedModel read_model(const std::string& file) {
  ChangedModel changed;
  changed.model = model::read_model(file, model::known_effects());
  changed.own = changed.model.effects.size();
  return changed;
}

ChangedModel fitted(const ChangedModel& model, const validation::Fit& fit, const Loaded& loaded) {
  ChangedModel changed = model;
  changed.source = "fit on ";
  std::string comma;
  for (const validation::Trial& trial : loaded.data->trials) {
    if (trial.role == validation::Role::train) {
      changed.source += comma + trial.name;
      comma = ", ";
    }
  }
  const std::vector<FreeParameter> parameters = validation::free_parameters(changed.model);
  for (const validation::FittedParameter& one : fit.parameters) {
    for (const FreeParameter& parameter : parameters) {
      if (one.seen() && parameter.label == one.label) {
        value_of(changed.model, parameter.id) = one.after;
        if (parameter.id.effect < static_cast<int>(changed.own)) {
          changed.set[one.label] = one.deviation;
        }
      }
    }
  }
  return changed;
}

ChangedModel diagnosed(const ChangedModel& model, const validation::Diagnosis& diagnosis) {
  ChangedModel changed = model;
  changed.source = "diagnose";
  validation::Stage stage = diagnosis.final_stage;
  stage.model = validation::fitted_model(stage);
  const model::Model& found = stage.model;
  const std::size_t given = model.model.effects.size();
  for (std::size_t e = 0; e < given; ++e) {
    changed.model.effects[e] = found.effects[e];
  }
  for (std::size_t e = given; e < found.effects.size(); ++e) {
    if (!found.effects[e].law->is_null(found.effects[e].numbers().data())) {
      changed.model.effects.push_back(found.effects[e]);
    }
  }
  for (const FreeParameter& parameter : moved_from(model.model, stage)) {
    if (parameter.id.effect < static_cast<int>(changed.own)) {
      changed.set[parameter.label] = 0.0;
    }
  }
  return changed;
}

ChangedModel with_effect(const ChangedModel& model, model::EffectUse use) {
  ChangedModel changed = model;
  changed.model.effects.push_back(std::move(use));
  return changed;
}

void save(const ChangedModel& changed, const std::string& file, const std::string& note) {
  std::vector<model::AddedEffect> added;
  for (std::size_t e = changed.own; e < changed.model.effects.size(); ++e) {
    const model::EffectUse& use = changed.model.effects[e];
    added.push_back({use.law->declaration().name, use.at, use.numbers(), has_one_before(changed.model, e)});
  }
  std::vector<model::NewValue> values;
  model::Model model = changed.model;
  for (const FreeParameter& parameter : validation::free_parameters(model)) {
    const auto set = changed.set.find(parameter.label);
    if (set != changed.set.end()) {
      values.push_back(
          {parameter.label, value_of(model, parameter.id), set->second, parameter.unit, changed.source});
    }
  }
  model::write_overlay(file, changed.model.file, added, values, note, model::known_effects());
}

}  // namespace plumbline::api
