#include "validation/identify/standard/standard_windows.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "validation/identify/compare/compare.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/predict/lost_windows.h"
#include "validation/identify/predict/reach.h"
#include "validation/identify/predict/zero_errors.h"
#include "validation/identify/standard/needed_torques.h"

namespace plumbline::validation {
namespace {

/// Of each motor, and of each joint that moves without one.
std::map<std::string, MotorScales> scales_of(PredictorPool& pool, const Estimate& given) {
  const effects::Catalogue friction({effects::Catalogue::all().find("viscous")});
  std::map<std::string, MotorScales> scales;
  for (const Candidate& one : list_candidates(pool, friction, {}, given)) {
    if (!floats(pool.model(), one.at)) {
      scales[one.at] = {one.scales.force, one.scales.velocity, one.scales.inertia};
    }
  }
  return scales;
}

Eigen::VectorXd values_from(const FreeModel& free, const FreeModel* other) {
  Eigen::VectorXd theta(static_cast<Eigen::Index>(free.values.size()));
  for (std::size_t i = 0; i < free.values.size(); ++i) {
    const FreeValue& value = free.values[i];
    double start = value.value;
    for (std::size_t k = 0; other != nullptr && k < other->values.size(); ++k) {
      if (other->values[k].label == value.label) {
        start = std::clamp(other->values[k].value, value.lower, value.upper);
      }
    }
    theta[static_cast<Eigen::Index>(i)] = start;
  }
  return theta;
}

double scale_of(const Estimate& estimate) { return std::max(1.0, estimate.scores.train); }

/// From these values to where less than a thousandth is gained, with the scale of the error that is there.
void search(PredictorPool& pool, const FreeModel& free, const EstimateOptions& options, Stage& stage) {
  constexpr int kScales = 3;
  constexpr double kMuch = 0.7;  // the scale that is left, as a share of the one that was searched with
  for (int i = 0; i < kScales; ++i) {
    const double scale = scale_of(stage.estimate);
    stage.parameters = as_parameters(free, scale);
    stage.estimate = gauss_newton(pool, stage.parameters, stage.estimate.theta, stage.estimate.x0, options);
    if (scale_of(stage.estimate) > kMuch * scale) {
      return;
    }
  }
}

/// As given, or with the values that the torques ask for: what leaves less.
void take_better_start(const FreeModel& free, const FreeModel* torques, const Data& data, Stage& stage) {
  stage.estimate.theta = values_from(free, nullptr);
  if (torques == nullptr) {
    return;
  }
  const Eigen::VectorXd theta = values_from(free, torques);
  PredictorPool pool(with_values(free.model, as_parameters(free, 1.0), theta), data);
  Estimate other = estimate_states(pool, stage.estimate.x0);
  if (other.scores.train < stage.estimate.scores.train) {
    stage.estimate = std::move(other);
    stage.estimate.theta = theta;
  }
}

int at_limits(const FreeModel& free, const Eigen::VectorXd& theta) {
  int count = 0;
  for (std::size_t i = 0; i < free.values.size(); ++i) {
    const double value = theta[static_cast<Eigen::Index>(i)];
    const double near = 1e-6 * free.values[i].spread;
    count += value <= free.values[i].lower + near || value >= free.values[i].upper - near ? 1 : 0;
  }
  return count;
}

WindowsFit fitted(const model::Model& model, Freed freed, const FreeModel* torques, const Followed& some,
                  const Data& all) {
  WindowsFit fit;
  PredictorPool given(model, some.data);
  fit.stage.estimate = estimate_states(given, some.x0);
  const FreeModel free = free_values(model, scales_of(given, fit.stage.estimate), freed);
  fit.stage.model = free.model;
  take_better_start(free, torques, some.data, fit.stage);
  PredictorPool few(free.model, some.data);
  search(few, free, {8, 3e-3, false}, fit.stage);
  PredictorPool pool(free.model, all);
  fit.stage.estimate =
      gauss_newton(pool, fit.stage.parameters, fit.stage.estimate.theta, {}, {4, 1e-3, false});
  fit.precision = precision_of(pool, all.windows_of(Role::train), fit.stage.parameters, fit.stage.estimate);
  fit.values = static_cast<int>(free.values.size());
  fit.at_limits = at_limits(free, fit.stage.estimate.theta);
  return fit;
}

/// Where a search begins with a kind's values as stated and the others as fitted. Empty where it has none of
/// the kind.
std::optional<Stage> without_kind(const WindowsFit& fit, const FreedKind& kind) {
  Stage stage;
  stage.model = fit.stage.model;
  std::vector<double> values;
  for (std::size_t p = 0; p < fit.stage.parameters.size(); ++p) {
    const FreeParameter& one = fit.stage.parameters[p];
    const model::EffectUse& use = fit.stage.model.effects[static_cast<std::size_t>(one.id.effect)];
    if (!kind.has(use.law->declaration().name)) {
      stage.parameters.push_back(one);
      values.push_back(fit.stage.estimate.theta[static_cast<Eigen::Index>(p)]);
    }
  }
  if (stage.parameters.size() == fit.stage.parameters.size()) {
    return {};
  }
  stage.estimate.theta =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  return stage;
}

std::vector<ToldValue> told_values(const WindowsFit& fit, const FreedKind& kind) {
  constexpr double kTold = 2.0;  // deviations, as Policy::told
  std::vector<ToldValue> told;
  for (Eigen::Index i = 0; i < fit.precision.deviations.size(); ++i) {
    const FreeParameter& one = fit.stage.parameters[static_cast<std::size_t>(i)];
    const model::EffectUse& use = fit.stage.model.effects[static_cast<std::size_t>(one.id.effect)];
    const double stated = use.values[static_cast<std::size_t>(one.id.parameter)].value;
    const double value = fit.stage.estimate.theta[i];
    const double deviation = fit.precision.deviations[i];
    if (kind.has(use.law->declaration().name) && std::abs(value - stated) > kTold * deviation) {
      told.push_back({one.label, one.unit, stated, value, deviation});
    }
  }
  return told;
}

}  // namespace

std::optional<WindowsFit> standard_by_windows(const model::Model& model, Freed freed,
                                              const FreeModel* torques, const Data& data, std::size_t windows,
                                              const Progress& progress) {
  if (model.motors.empty()) {
    return {};
  }
  progress("standard identification", 0.0);
  try {
    std::vector<LostWindow> lost;
    const Data all = without_lost(model, data, lost);
    const model::Model zeroed = with_zero_errors(model, all);
    const Followed some = follow(zeroed, all.thinned(windows));
    if (!is_whole(some)) {
      return {};
    }
    WindowsFit fit = fitted(zeroed, freed, torques, some, all);
    fit.scores = compare(fitted_model(fit.stage), data).scores;
    return fit;
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};  // with so much freedom it cannot be integrated
  }
}

std::vector<KindShare> kind_shares(const WindowsFit& fit, const Data& data) {
  constexpr EstimateOptions kSearch{6, 3e-3, false};
  std::vector<KindShare> shares;
  for (const FreedKind& kind : freed_kinds()) {
    const std::optional<Stage> without = without_kind(fit, kind);
    if (!without) {
      continue;
    }
    KindShare share{kind.name, std::numeric_limits<double>::infinity(), told_values(fit, kind)};
    try {
      PredictorPool pool(fitted_model(*without), data);
      const Scores scores =
          gauss_newton(pool, without->parameters, without->estimate.theta, {}, kSearch).scores;
      share.without = judged(scores, data);
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      share.without = std::numeric_limits<double>::infinity();  // too far away to be integrated
    }
    shares.push_back(share);
  }
  std::stable_sort(shares.begin(), shares.end(),
                   [](const KindShare& a, const KindShare& b) { return a.without > b.without; });
  return shares;
}

WindowsFit fitted_on_all(const Stage& stage, const Data& data) {
  std::vector<LostWindow> lost;
  const Data all = without_lost(stage.model, data, lost);
  WindowsFit fit;
  fit.stage = stage;
  PredictorPool pool(fitted_model(stage), all);
  fit.stage.estimate = gauss_newton(pool, stage.parameters, stage.estimate.theta, {}, {12, 1e-4, false});
  fit.precision = precision_of(pool, all.windows_of(Role::train), stage.parameters, fit.stage.estimate);
  fit.values = static_cast<int>(stage.parameters.size());
  fit.scores = compare(fitted_model(fit.stage), data).scores;
  return fit;
}

WindowsFit as_windows_fit(const FreeModel& torques, const Scores& scores) {
  WindowsFit fit;
  fit.scores = scores;
  fit.values = static_cast<int>(torques.values.size());
  fit.stage.parameters = as_parameters(torques, 1.0);
  const Eigen::VectorXd theta = values_from(torques, nullptr);
  fit.precision.deviations.resize(theta.size());
  for (std::size_t i = 0; i < torques.values.size(); ++i) {
    fit.precision.deviations[static_cast<Eigen::Index>(i)] = torques.values[i].deviation;
  }
  fit.precision.correlation = torques.correlation;
  fit.at_limits = at_limits(torques, theta);
  fit.stage.model = torques.model;
  fit.stage.estimate.theta = theta;
  return fit;
}

}  // namespace plumbline::validation
