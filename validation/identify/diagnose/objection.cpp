#include "validation/identify/diagnose/objection.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/identify/diagnose/family.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/predict/carried_states.h"
#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {
namespace {

/// The parameters of one effect and their fitted values.
struct OwnPart {
  std::vector<FreeParameter> parameters;
  Eigen::VectorXd theta;
};

OwnPart part_of(const Refit& refit, const Eigen::VectorXd& theta, int effect) {
  OwnPart part;
  std::vector<double> values;
  for (std::size_t p = 0; p < refit.extended.parameters.size(); ++p) {
    if (refit.extended.parameters[p].id.effect == effect) {
      part.parameters.push_back(refit.extended.parameters[p]);
      values.push_back(theta[static_cast<Eigen::Index>(p)]);
    }
  }
  part.theta = Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return part;
}

/// Mean square (Refit::square) of a model with these parameters fitted anew.
double square_anew(const model::Model& model, const std::vector<FreeParameter>& parameters,
                   const std::vector<Eigen::VectorXd>& x0, const Data& data) {
  constexpr int kIterations = 8;
  PredictorPool pool(model, data);
  return gauss_newton(pool, parameters, values_of(model, parameters), x0,
                      {kIterations, kRefitTolerance, false})
      .predicted.scores.square();
}

/// Of a refit with one parameter held where it is and all others fitted anew.
double square_held(std::size_t parameter, const Refit& refit, const Data& data) {
  std::vector<FreeParameter> others = refit.extended.parameters;
  const model::Model held = with_values(refit.extended.model, others, refit.estimate.predicted.theta);
  others.erase(others.begin() + static_cast<std::ptrdiff_t>(parameter));
  return square_anew(held, others, refit.estimate.x0, data);
}

/// The same with the parameter at its null value, where the law is null: with its states and its other values
/// it leaves the model. Kept beside it they could do what it did: next to no time constant, under any
/// damping, is a lag of first order.
double square_without(std::size_t parameter, double null, const Refit& refit, const Data& data) {
  const model::ParameterId id = refit.extended.parameters[parameter].id;
  std::vector<FreeParameter> others = refit.extended.parameters;
  const model::Model with = with_values(refit.extended.model, others, refit.estimate.predicted.theta);
  model::Model without = with;
  without.effects[static_cast<std::size_t>(id.effect)].values[static_cast<std::size_t>(id.parameter)].value =
      null;
  others.erase(std::remove_if(others.begin(), others.end(),
                              [&](const FreeParameter& one) { return one.id.effect == id.effect; }),
               others.end());
  return square_anew(without, others, carried_states(with, without, data, refit.estimate.x0), data);
}

/// Is the error materially larger at the null value than at the value, whatever the other parameters do
/// (profile likelihood)? That an effect is there and how strong it is are two questions: a strength that
/// trades with a torque constant is open, the effect need not be. Where the model cannot be integrated it is
/// not known: no.
bool is_needed(std::size_t parameter, double null, const Refit& refit, const Data& data,
               const Policy& policy) {
  const double most = 1.0 + policy.material;
  try {
    return square_without(parameter, null, refit, data) > most * most * square_held(parameter, refit, data);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Name of a parameter without which the law would be null and which cannot be told from its null value: play
/// without a gap, a stretch without a compliance. Then something else about the law must have helped. Its
/// deviation alone does not show this: that is of a straight line, along which a stiffness becomes nothing
/// while the rest does not go to where the same force would ask for it.
std::string undecided(const Refit& refit, const Data& data, const Policy& policy) {
  PredictorPool pool(refit.extended.model, data);
  const std::vector<FreeParameter>& parameters = refit.extended.parameters;
  Estimate at = refit.estimate;
  at.theta = refit.estimate.predicted.theta;
  const Eigen::VectorXd deviations = precision_of(pool, data.all_windows(), parameters, at).deviations;
  const model::Model fitted = with_values(refit.extended.model, parameters, at.theta);
  for (std::size_t p = parameters.size() - static_cast<std::size_t>(refit.own); p < parameters.size(); ++p) {
    const model::EffectUse& use = fitted.effects[static_cast<std::size_t>(parameters[p].id.effect)];
    const effects::Values values = use.numbers();
    const auto own = static_cast<std::size_t>(parameters[p].id.parameter);
    const double null = use.law->declaration().parameters[own].null_value;
    effects::Values without = values;
    without[own] = null;
    const effects::Scale scale = parameters[p].scale;
    const double distance = std::abs(to_search(scale, values[own]) - to_search(scale, null));
    const double deviation =
        deviations[static_cast<Eigen::Index>(p)] / std::abs(search_slope(scale, values[own]));
    if (use.law->is_null(without.data()) && distance < policy.told * deviation &&
        !is_needed(p, null, refit, data, policy)) {
      return parameters[p].label;
    }
  }
  return "";
}

/// Is the parameter the level of a dry friction that has a rise at low speed, too (Stribeck, LuGre)? Without
/// a level it would leave the surfaces without any friction once they slide, unless another law of the model
/// has it.
bool is_level_below_rise(const FreeParameter& one, const Refit& refit) {
  const std::vector<model::EffectUse>& effects = refit.extended.model.effects;
  const model::EffectUse& use = effects[static_cast<std::size_t>(one.id.effect)];
  const std::vector<effects::Parameter>& all = use.law->declaration().parameters;
  const auto is_rise = [](const effects::Parameter& other) { return other.name == "rise"; };
  const auto is_beside = [&](const model::EffectUse& other) {
    return &other != &use && other.at == use.at && is_friction(*other.law);
  };
  return all[static_cast<std::size_t>(one.id.parameter)].name == "level" &&
         std::any_of(all.begin(), all.end(), is_rise) &&
         std::none_of(effects.begin(), effects.end(), is_beside);
}

std::string percent(double share) {
  return std::to_string(static_cast<int>(std::lround(100.0 * share))) + " %";
}

/// What `check` says of a refit, if the model can be integrated close to its values.
template <typename Check>
std::string unless_unsteady(const Check& check) {
  try {
    return check();
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return "unsteady: close to its fitted values it cannot be integrated";
  }
}

}  // namespace

bool on_bound(const FreeParameter& parameter, double value) {
  const double reach = 1e-9 * std::max(parameter.typical, std::abs(value));  // the search stops on a bound
  return value - parameter.lower < reach || parameter.upper - value < reach;
}

std::string unphysical(const Refit& refit) {
  for (const int effect : refit.added) {
    const OwnPart own = part_of(refit, refit.estimate.predicted.theta, effect);
    for (std::size_t p = 0; p < own.parameters.size(); ++p) {
      const FreeParameter& one = own.parameters[p];
      if ((own.parameters.size() == 1 || one.physical || one.scale == effects::Scale::reciprocal ||
           is_level_below_rise(one, refit)) &&
          on_bound(one, own.theta[static_cast<Eigen::Index>(p)])) {
        return one.label;
      }
    }
  }
  return "";
}

// The held-out motion may be the one that decides: at the values that serve all windows, of those that the
// train windows leave open.
std::string flaw(const Refit& refit, const Data& data, const Policy& policy) {
  const std::string bound = unphysical(refit);
  if (!bound.empty()) {
    return "unphysical: " + bound + " is at its bound";
  }
  return unless_unsteady([&]() -> std::string {
    const std::string open = undecided(refit, data, policy);
    return open.empty() ? "" : "undecided: " + open + " cannot be told from no effect";
  });
}

std::string refusal(const Stage& stage, const Refit& refit, const Data& data, const Policy& policy) {
  const Scores& before = stage.estimate.predicted.scores;
  const Scores& after = refit.estimate.predicted.scores;
  const bool judged = data.has(Role::held_out);
  const double fall = judged ? 1.0 - after.held_out / before.held_out : 1.0 - after.train / before.train;
  if (fall < policy.material) {
    const std::string error = judged ? "held-out error" : "train error";
    return "immaterial: " + error + (fall < 0.0 ? " rises by " : " falls by only ") + percent(std::abs(fall));
  }
  return flaw(refit, data, policy);
}

std::string objection(double share, const Policy& policy) {
  return share < policy.stable ? "unstable: chosen in only " + percent(share) + " of the resamples" : "";
}

}  // namespace plumbline::validation
