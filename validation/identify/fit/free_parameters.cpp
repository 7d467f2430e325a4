#include "validation/identify/fit/free_parameters.h"

#include <fnmatch.h>

#include <algorithm>
#include <cmath>

#include "simulator/trace/error.h"
#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/diagnose/physical_limits.h"
#include "validation/identify/fit/scales.h"

namespace plumbline::validation {
namespace {

const model::EffectUse& use_of(const model::Model& model, const FreeParameter& parameter) {
  return model.effects[static_cast<std::size_t>(parameter.id.effect)];
}

double value_of(const model::Model& model, const FreeParameter& parameter) {
  return use_of(model, parameter).values[static_cast<std::size_t>(parameter.id.parameter)].value;
}

/// "#2" for the second use of a law at a place, as overlays count them; nothing for the first.
std::string repetition(const model::Model& model, std::size_t effect) {
  const model::EffectUse& use = model.effects[effect];
  const auto before = model.effects.begin() + static_cast<std::ptrdiff_t>(effect);
  const auto number =
      1 + std::count_if(model.effects.begin(), before, [&](const model::EffectUse& other) {
        return other.law->declaration().name == use.law->declaration().name && other.at == use.at;
      });
  return number == 1 ? "" : "#" + std::to_string(number);
}

std::string all_labels(const std::vector<FreeParameter>& parameters) {
  std::string text;
  for (const FreeParameter& parameter : parameters) {
    text += (text.empty() ? "" : ", ") + parameter.label;
  }
  return text;
}

}  // namespace

std::vector<FreeParameter> free_parameters(const model::Model& model) {
  std::vector<FreeParameter> all;
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    const model::EffectUse& use = model.effects[e];
    const bool angular = model.place_is_angular(model.resolve(*use.law, use.at), use.at);
    const std::string number = repetition(model, e);
    for (FreeParameter& parameter : free_parameters_of(use, static_cast<int>(e), {}, angular)) {
      keep_physical(model, use, parameter);
      parameter.label.insert(parameter.label.find(':'), number);
      all.push_back(std::move(parameter));
    }
  }
  return all;
}

std::vector<FreeParameter> matching(const std::vector<FreeParameter>& parameters,
                                    const std::vector<std::string>& patterns) {
  if (parameters.empty()) {
    throw InputError("--free: found a model without effects, expected parameters to fit (`plumbline add`)");
  }
  std::vector<bool> chosen(parameters.size(), false);
  for (const std::string& pattern : patterns) {
    bool any = false;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      const bool match = fnmatch(pattern.c_str(), parameters[p].label.c_str(), 0) == 0;
      chosen[p] = chosen[p] || match;
      any = any || match;
    }
    if (!any) {
      throw InputError({"", 0, "--free"}, "\"" + pattern + "\", which matches nothing",
                       "a pattern that matches some of: " + all_labels(parameters));
    }
  }
  std::vector<FreeParameter> free;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (chosen[p]) {
      free.push_back(parameters[p]);
    }
  }
  return free;
}

void check_can_move(const model::Model& model, const std::vector<FreeParameter>& parameters) {
  for (const FreeParameter& parameter : parameters) {
    const model::EffectUse& use = use_of(model, parameter);
    const bool grows = use.law->state_count() > 0 || model.resolve(*use.law, use.at) == effects::Place::ratio;
    if (grows && use.law->is_null(use.numbers().data())) {
      throw InputError({model.file, use.line, parameter.label}, "an effect at its null values",
                       "start values from which a fit can go on (`plumbline add` gives some)");
    }
  }
}

void set_typical(const model::Model& model, const Data& data, std::vector<FreeParameter>& parameters) {
  for (FreeParameter& parameter : parameters) {
    const double value = value_of(model, parameter);
    const bool is_size = parameter.scale != effects::Scale::logarithm;
    if (is_size && std::isfinite(value) && value != 0.0) {
      parameter.typical = std::abs(value);
      continue;
    }
    const model::EffectUse& use = use_of(model, parameter);
    const effects::Scales scales = scales_at(model, use.law, use.at, data);
    parameter.typical = use.law->typical(scales)[static_cast<std::size_t>(parameter.id.parameter)];
  }
}

}  // namespace plumbline::validation
