#include "validation/identify/standard/torque_screen.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/diagnose/own_parameters.h"
#include "validation/identify/diagnose/policy.h"

namespace plumbline::validation {
namespace {

FreeValue free_value(const model::Model& model, const FreeParameter& parameter) {
  FreeValue value;
  value.label = parameter.label;
  value.unit = parameter.unit;
  value.id = parameter.id;
  value.stated = value.value = model.effects[static_cast<std::size_t>(parameter.id.effect)]
                                   .values[static_cast<std::size_t>(parameter.id.parameter)]
                                   .value;
  value.known = std::isfinite(parameter.deviation);
  value.spread = value.known ? parameter.deviation : std::abs(parameter.typical);
  value.physical = parameter.physical;
  value.lower = std::min(parameter.lower, value.stated);
  value.upper = std::max(parameter.upper, value.stated);
  return value;
}

class Screen {
 public:
  Screen(const TorqueProblem& problem, FreeModel own, const Data& data) : problem_(problem), data_(data) {
    stated_ = origin(own);
    problem_.search(own);
    fitted_ = origin(std::move(own));
    cost_ = problem_.cost(fitted_.own);
    positions_ = model::Plant(fitted_.own.model, {}).positions();
  }

  const FreeModel& own() const { return fitted_.own; }

  /// The best of the law's starts after a few steps; no gain where it cannot be asked.
  TorqueCandidate asked(const Candidate& candidate) const {
    TorqueCandidate best;
    best.law = candidate.law->declaration().name;
    best.at = candidate.at;
    best.choices = choices_of(candidate);
    ask(candidate, fitted_, kFirstSteps, best);
    return best;
  }

  /// More steps; and all of them from the model's own numbers as they are stated, which without the candidate
  /// may have gone far to make up for it.
  void improve(const Candidate& candidate, TorqueCandidate& best) const {
    fit(best.free, fitted_, kFurtherSteps);
    best.gain = gain_of(best.free, best.choices);
    ask(candidate, stated_, kFurtherSteps, best);
  }

  /// Is one of its own values where the robot cannot be?
  bool is_at_limit(const TorqueCandidate& candidate) const {
    const auto first = candidate.free.values.begin() + static_cast<std::ptrdiff_t>(count());
    return std::any_of(first, candidate.free.values.end(),
                       [](const FreeValue& value) { return value.is_unphysical(); });
  }

  /// All slopes anew: what was held from the model's own numbers alone may have changed.
  void settle(TorqueCandidate& candidate) const {
    problem_.search(candidate.free);
    candidate.gain = gain_of(candidate.free, candidate.choices);
  }

 private:
  static constexpr int kFirstSteps = 2;
  static constexpr int kFurtherSteps = 6;

  /// The model's own numbers somewhere, with their slopes there.
  struct Origin {
    FreeModel own;
    TorqueSlopes slopes;
  };

  Origin origin(FreeModel own) const {
    TorqueSlopes slopes = problem_.slopes(own, 0, problem_.errors(identified(own)));
    return {std::move(own), std::move(slopes)};
  }

  std::size_t count() const { return fitted_.own.values.size(); }

  void ask(const Candidate& candidate, const Origin& from, int most_steps, TorqueCandidate& best) const {
    // One step from each start tells which is worth more.
    std::optional<FreeModel> nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const effects::Values& start : starts_of(from.own.model, candidate)) {
      FreeModel free = extended(from.own, candidate, start);
      if (free.values.size() == count() || !fit(free, from, 1)) {
        continue;
      }
      const double cost = problem_.cost(free);
      if (cost < least) {
        least = cost;
        nearest = std::move(free);
      }
    }
    if (nearest && fit(*nearest, from, most_steps - 1)) {
      keep_if_better(std::move(*nearest), best);
    }
  }

  static FreeModel extended(FreeModel free, const Candidate& candidate, const effects::Values& start) {
    free.model.effects.push_back(make_use(candidate, start));
    const int index = static_cast<int>(free.model.effects.size()) - 1;
    for (const FreeParameter& parameter : searched_parameters_of(free.model, candidate, index)) {
      free.values.push_back(free_value(free.model, parameter));
    }
    return free;
  }

  bool is_shown(const FreeModel& free) const {
    const Trial& trial = data_.trials.front();
    const model::Plant plant(as_recorded(free.model, trial), trial.locks, trial.terrain);
    return plant.states() == 2 * plant.positions() && model::Plant(free.model, {}).positions() == positions_;
  }

  /// False where it cannot be asked. The slopes of the model's own numbers stay those of the origin: the
  /// errors are affine, and the cost itself decides on each step.
  bool fit(FreeModel& free, const Origin& from, int most_steps) const {
    constexpr double kWorthwhile = 1.0;
    if (!is_shown(free)) {
      return false;
    }
    for (int i = 0; i < most_steps && std::isfinite(problem_.cost(free)); ++i) {
      const TorqueErrors errors = problem_.errors(identified(free));
      TorqueSlopes slopes = from.slopes;
      for (TorqueErrors& one : problem_.slopes(free, count(), errors)) {
        slopes.push_back(std::move(one));
      }
      if (problem_.step(free, errors, slopes) < kWorthwhile) {
        break;
      }
    }
    return true;
  }

  double gain_of(const FreeModel& free, int choices) const {
    return cost_ - problem_.cost(free) - penalty_of(free.values.size() - count(), choices, problem_);
  }

  int choices_of(const Candidate& candidate) const {
    const std::vector<effects::Parameter>& parameters = candidate.law->declaration().parameters;
    std::set<effects::Values> different;
    for (effects::Values start : starts_of(fitted_.own.model, candidate)) {
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        start[p] = parameters[p].structural ? start[p] : 0.0;
      }
      different.insert(std::move(start));
    }
    return std::max(1, static_cast<int>(different.size()));
  }

  void keep_if_better(FreeModel free, TorqueCandidate& best) const {
    const double gain = gain_of(free, best.choices);
    if (!(gain > best.gain)) {
      return;
    }
    best.gain = gain;
    best.parameters.clear();
    for (std::size_t i = count(); i < free.values.size(); ++i) {
      best.parameters.push_back(free.values[i].label);
    }
    best.free = std::move(free);
  }

  const TorqueProblem& problem_;
  const Data& data_;
  Origin stated_, fitted_;
  double cost_ = 0.0;
  int positions_ = 0;
};

/// Torques may ask for numbers with which no motion can be integrated; the model as stated then says what can
/// be asked of it.
std::vector<Candidate> candidates_at(const FreeModel& own, const effects::Catalogue& catalogue,
                                     const Data& data) {
  PredictorPool fitted(identified(own), data);
  const Estimate estimate = estimate_states(fitted);
  if (is_finite(estimate)) {
    return list_candidates(fitted, catalogue, {}, estimate);
  }
  PredictorPool stated(own.model, data);
  return list_candidates(stated, catalogue, {}, estimate_states(stated));
}

/// Without those that `own` has values of already: what a model states of a number, with its uncertainty, is
/// known of it, and a second one of the kind without any would only go round that.
std::vector<Candidate> candidates_of(const FreeModel& own, const effects::Catalogue& catalogue,
                                     const Data& data) {
  std::vector<Candidate> candidates = candidates_at(own, catalogue, data.thinned(Policy{}.windows));
  const auto is_named = [&](const Candidate& candidate) {
    return std::any_of(own.values.begin(), own.values.end(), [&](const FreeValue& value) {
      return own.model.effects[static_cast<std::size_t>(value.id.effect)].label() == candidate.label();
    });
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_named), candidates.end());
  return candidates;
}

void sort_by_gain(std::vector<TorqueCandidate>& ranked) {
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const TorqueCandidate& a, const TorqueCandidate& b) { return a.gain > b.gain; });
}

}  // namespace

double penalty_of(std::size_t fitted, int choices, const TorqueProblem& problem) {
  return static_cast<double>(fitted) * std::log(problem.independent_samples()) + 2.0 * std::log(choices);
}

FreeModel own_numbers(const model::Model& model) {
  FreeModel free;
  free.model = with_stated_errors(model);
  free.own = model.effects.size();
  for (const FreeParameter& parameter :
       stated_parameters(free.model, std::numeric_limits<double>::infinity())) {
    free.values.push_back(free_value(free.model, parameter));
  }
  return free;
}

TorqueScreen torque_screen(const TorqueProblem& problem, FreeModel own, const effects::Catalogue& catalogue,
                           const Data& data, const Progress& progress) {
  constexpr std::size_t kImproved = 12;
  constexpr std::size_t kSettled = 4;
  TorqueScreen result;
  const Screen screen(problem, std::move(own), data);
  result.own = screen.own();
  const std::vector<Candidate> candidates = candidates_of(result.own, catalogue, data);
  const auto stop_if_asked = [&] {
    if (data.stop != nullptr && data.stop->raised) {
      throw Stopped();
    }
  };
  progress("torques of " + std::to_string(candidates.size()) + " candidates", 0.0);
  std::vector<TorqueCandidate> asked(candidates.size());
  parallel_for(static_cast<int>(candidates.size()), data.threads, [&](int c) {
    stop_if_asked();
    asked[static_cast<std::size_t>(c)] = screen.asked(candidates[static_cast<std::size_t>(c)]);
  });
  for (TorqueCandidate& one : asked) {
    if (one.gain > 0.0) {
      result.ranked.push_back(std::move(one));
    }
  }
  sort_by_gain(result.ranked);
  progress("torques of the most promising", 0.5);
  parallel_for(static_cast<int>(std::min(kImproved, result.ranked.size())), data.threads, [&](int k) {
    stop_if_asked();
    const auto i = static_cast<std::size_t>(k);
    const auto same = std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& one) {
      return one.label() == result.ranked[i].label();
    });
    screen.improve(*same, result.ranked[i]);
  });
  sort_by_gain(result.ranked);
  for (std::size_t i = 0; i < std::min(kSettled, result.ranked.size()); ++i) {
    screen.settle(result.ranked[i]);
  }
  const auto is_none = [&](const TorqueCandidate& one) { return one.gain <= 0.0 || screen.is_at_limit(one); };
  result.ranked.erase(std::remove_if(result.ranked.begin(), result.ranked.end(), is_none),
                      result.ranked.end());
  sort_by_gain(result.ranked);
  return result;
}

}  // namespace plumbline::validation
