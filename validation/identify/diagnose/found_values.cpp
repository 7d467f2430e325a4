#include "validation/identify/diagnose/found_values.h"

#include <cmath>

namespace plumbline::validation {
namespace {

/// As the finding says, NaN where it does not.
double deviation_of_finding(const Diagnosis& diagnosis, const model::EffectUse& use,
                            const std::string& parameter) {
  for (const Finding& finding : diagnosis.accepted) {
    if (finding.effect != use.law->declaration().name || finding.at != use.at) {
      continue;
    }
    for (const ParameterValue& value : finding.parameters) {
      if (value.name == parameter && !value.chosen && value.deviation > 0.0) {
        return value.deviation;
      }
    }
  }
  return std::nan("");
}

}  // namespace

double found_deviation(const Diagnosis& diagnosis, const model::ParameterId& id) {
  const Stage& stage = diagnosis.final_stage;
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    const FreeParameter& parameter = stage.parameters[p];
    if (parameter.id.effect != id.effect || parameter.id.parameter != id.parameter) {
      continue;
    }
    const auto index = static_cast<Eigen::Index>(p);
    if (diagnosis.precision.deviations.size() > index) {
      return diagnosis.precision.deviations[index];
    }
    const model::EffectUse& use = stage.model.effects[static_cast<std::size_t>(id.effect)];
    const double found = deviation_of_finding(
        diagnosis, use, use.law->declaration().parameters[static_cast<std::size_t>(id.parameter)].name);
    return std::isfinite(found) || !std::isfinite(parameter.deviation) ? found : parameter.deviation;
  }
  return std::nan("");
}

effects::Values found_deviations(const Diagnosis& diagnosis, int effect) {
  const model::EffectUse& use = diagnosis.final_stage.model.effects[static_cast<std::size_t>(effect)];
  effects::Values all;
  for (int p = 0; p < use.law->parameter_count(); ++p) {
    all.push_back(found_deviation(diagnosis, {effect, p}));
  }
  return all;
}

}  // namespace plumbline::validation
