#include "validation/identify/suggest/suggest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "validation/identify/diagnose/refit.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr double kLeastShare = 0.01;  // of the commands' reach: less is no excitation

bool is_named(const Candidate& candidate, const std::string& name) {
  const std::string& law = candidate.law->declaration().name;
  return name == candidate.label() ||
         std::any_of(candidate.same_places.begin(), candidate.same_places.end(),
                     [&](const std::string& place) { return name == law + "@" + place; });
}

Candidate find_candidate(const std::vector<Candidate>& candidates, const std::string& name) {
  std::vector<std::string> known;
  for (const Candidate& candidate : candidates) {
    if (is_named(candidate, name)) {
      return candidate;
    }
    known.push_back(candidate.label());
  }
  throw InputError("--between: found '" + name + "', expected an effect at a place that these trials move" +
                   nearest_names(name, known));
}

Explanation explanation_of(const Refit& refit, const Candidate& candidate) {
  Explanation one;
  one.name = candidate.label();
  one.theta = refit.estimate.theta.tail(refit.own);
  one.parameters.assign(refit.extended.parameters.end() - refit.own, refit.extended.parameters.end());
  one.model = with_values(refit.extended.model, refit.extended.parameters, refit.estimate.theta);
  one.scores = refit.estimate.scores;
  return one;
}

/// The trials explained by each of the named effects alone.
std::vector<Explanation> explain(const model::Model& model, const effects::Catalogue& catalogue,
                                 const Data& data, const std::vector<std::string>& names,
                                 const Progress& progress) {
  progress("the model as given", 0.0);
  PredictorPool pool(model, data);
  const Stage stage{model, {}, estimate_states(pool)};
  const std::vector<Candidate> all = list_candidates(pool, catalogue, {}, stage.estimate);
  std::vector<Explanation> explanations;
  for (const std::string& name : names) {
    progress("explaining the trials by " + name, 0.05);
    const std::vector<Candidate> only{find_candidate(all, name)};
    const std::vector<Refit> refits =
        refit(stage, only, screen(stage, only, data, progress), data, {}, progress);
    if (refits.empty()) {
      throw InputError("--between: found no values of '" + name +
                       "' with which these trials can be predicted");
    }
    explanations.push_back(explanation_of(refits.front(), only.front()));
  }
  return explanations;
}

/// What an explanation leaves of a twin's windows, its own values free or as they are.
Estimate left_by(const Explanation& one, const Data& twin, bool free) {
  PredictorPool pool(one.model, twin);
  const std::vector<FreeParameter> parameters = free ? one.parameters : std::vector<FreeParameter>{};
  return gauss_newton(pool, parameters, free ? one.theta : Eigen::VectorXd(), {}, {10, 1e-3});
}

/// Seconds until the mean of the windows' differences is three standard errors from zero.
double seconds_to_tell(const Estimate& wrong, const Estimate& right, double window) {
  constexpr double kErrors = 3.0;
  Eigen::VectorXd difference(static_cast<Eigen::Index>(wrong.square.size()));
  for (std::size_t w = 0; w < wrong.square.size(); ++w) {
    difference[static_cast<Eigen::Index>(w)] = wrong.square[w].sum() - right.square[w].sum();
  }
  const double mean = difference.mean();
  if (!(mean > 0.0)) {
    return kInfinite;
  }
  const auto n = static_cast<double>(difference.size());
  const double variance = (difference.array() - mean).square().sum() / std::max(1.0, n - 1.0);
  return window * std::max(1.0, std::ceil(kErrors * kErrors * variance / (mean * mean)));
}

class Player {
 public:
  Player(const std::vector<Explanation>& explanations, const Envelope& envelope, const Data& like)
      : explanations_(explanations), envelope_(envelope), like_(like) {}

  /// How a proposal separates each pair; false when the motion leaves the range.
  bool play(const Proposal& proposal, Separation& separation) const {
    separation.name = proposal.name;
    separation.text = proposal.text;
    separation.pairs.clear();
    for (std::size_t right = 0; right < explanations_.size(); ++right) {
      const Trial trial = twin(explanations_[right].model, proposal.experiment, {1, 1e-7, true});
      if (!stays_within(envelope_, trial)) {
        return false;
      }
      Data data({trial}, like_.predict);
      data.threads = like_.threads;
      data.stop = like_.stop;
      const Estimate truth = left_by(explanations_[right], data, false);
      for (std::size_t wrong = 0; wrong < explanations_.size(); ++wrong) {
        if (wrong != right) {
          hold_against(right, wrong, truth, left_by(explanations_[wrong], data, true), separation.pairs);
        }
      }
    }
    return true;
  }

 private:
  /// Whichever of the two is true, the other one must fail.
  void hold_against(std::size_t right, std::size_t wrong, const Estimate& truth, const Estimate& other,
                    std::vector<PairSeparation>& pairs) const {
    const PairSeparation found{std::min(right, wrong), std::max(right, wrong), other.scores.train,
                               seconds_to_tell(other, truth, like_.predict.window)};
    for (PairSeparation& pair : pairs) {
      if (pair.one == found.one && pair.other == found.other) {
        pair.error = std::min(pair.error, found.error);
        pair.seconds = std::max(pair.seconds, found.seconds);
        return;
      }
    }
    pairs.push_back(found);
  }

  const std::vector<Explanation>& explanations_;
  const Envelope& envelope_;
  const Data& like_;
};

/// Where the first trial begins, by all coordinates of the model.
std::vector<Start> start_of(const model::Model& model, const Data& data) {
  const Window& first = data.windows.front();
  Predictor predictor(model, data.trials[static_cast<std::size_t>(first.trial)], data.predict);
  const Eigen::VectorXd x = predictor.initial_state(first);
  std::vector<Start> start;
  for (const model::Coordinate& coordinate : model.coordinates) {
    start.push_back({coordinate.name, predictor.plant().position_of(coordinate.name, x.data())});
  }
  return start;
}

/// Pairs that no experiment separates are set aside; of the others the worst counts.
void weigh(Suggestions& suggestions) {
  std::vector<Separation>& experiments = suggestions.experiments;
  const std::size_t pairs = experiments.empty() ? 0 : experiments.front().pairs.size();
  for (std::size_t p = 0; p < pairs; ++p) {
    const bool separable = std::any_of(experiments.begin(), experiments.end(), [&](const Separation& one) {
      return std::isfinite(one.pairs[p].seconds);
    });
    if (!separable) {
      const PairSeparation& pair = experiments.front().pairs[p];
      suggestions.inseparable.emplace_back(suggestions.explanations[pair.one].name,
                                           suggestions.explanations[pair.other].name);
      continue;
    }
    for (Separation& one : experiments) {
      one.error = one.seconds > 0.0 ? std::min(one.error, one.pairs[p].error) : one.pairs[p].error;
      one.seconds = std::max(one.seconds, one.pairs[p].seconds);
    }
  }
  std::stable_sort(experiments.begin(), experiments.end(), [](const Separation& a, const Separation& b) {
    return a.seconds != b.seconds ? a.seconds < b.seconds : a.error > b.error;
  });
}

}  // namespace

Suggestions suggest(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                    const std::vector<std::string>& names, const Progress& progress) {
  if (names.size() < 2) {
    throw InputError("--between: found fewer than two effects, expected those that are to be told apart");
  }
  Suggestions suggestions;
  suggestions.explanations = explain(model, catalogue, data, names, progress);
  const Envelope envelope = envelope_of(data.trials, start_of(model, data));
  const Player player(suggestions.explanations, envelope, data);
  const std::vector<Idea> ideas = ideas_for(envelope);
  for (std::size_t i = 0; i < ideas.size(); ++i) {
    progress("playing " + ideas[i].name,
             0.1 + 0.9 * static_cast<double>(i) / static_cast<double>(ideas.size()));
    bool played = false;
    for (double share = 1.0; share > kLeastShare && !played; share *= 0.5) {
      Separation separation;
      separation.share = share;
      try {
        played = player.play(propose(model, envelope, ideas[i], share), separation);
      } catch (const Stopped&) {
        throw;
      } catch (const std::runtime_error&) {
        continue;  // too violent to be integrated: less of it
      }
      if (played) {
        suggestions.experiments.push_back(std::move(separation));
      }
    }
    suggestions.refused += played ? 0 : 1;
  }
  weigh(suggestions);
  return suggestions;
}

}  // namespace plumbline::validation
