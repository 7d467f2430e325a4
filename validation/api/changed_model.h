// A model that was read from a file and changed since: effects added, values set; and how it is written.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "validation/api/diagnosing.h"
#include "validation/api/fitting.h"

namespace plumbline::api {

struct ChangedModel {
  model::Model model;
  std::size_t own = 0;  ///< how many effects the file has; those behind them were added
  /// Values of the file's effects that were set, by label ("viscous@mLA:damping"): one standard deviation.
  std::map<std::string, double> set;
  std::string source;  ///< of these
};

/// Of a parameter, SI.
double value_at(const model::Model& model, const model::ParameterId& id);

ChangedModel read_model(const std::string& file);

/// The model with the values of a fit that the data depend on.
ChangedModel fitted(const ChangedModel& model, const validation::Fit& fit, const Loaded& loaded);

/// The model with what a diagnosis added and moved.
ChangedModel diagnosed(const ChangedModel& model, const validation::Diagnosis& diagnosis);

/// Parameters of the given model's own effects that a diagnosis left open, or holds at another value than the
/// model states: what the error rests on, and must be written. `found.model` has the values that were found.
std::vector<validation::FreeParameter> moved_from(const model::Model& given, const validation::Stage& found);

/// The model with one effect more.
ChangedModel with_effect(const ChangedModel& model, model::EffectUse use);

/// An overlay on the model's file. Throws InputError as model::write_overlay does.
void save(const ChangedModel& changed, const std::string& file, const std::string& note);

}  // namespace plumbline::api
