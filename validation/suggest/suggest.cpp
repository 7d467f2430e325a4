#include "validation/suggest/suggest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/trace/error.h"
#include "validation/diagnose/confirm.h"
#include "validation/twin/twin.h"

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
  const Stage stage{model, {}, gauss_newton(pool, {}, Eigen::VectorXd(), {}, {8, 1e-4})};
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

  /// The separation that a proposal brings; false when the motion leaves the range.
  bool play(const Proposal& proposal, Separation& separation) const {
    separation.name = proposal.name;
    separation.text = proposal.text;
    separation.error = kInfinite;
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
          hold_against(truth, left_by(explanations_[wrong], data, true), separation);
        }
      }
    }
    return true;
  }

 private:
  void hold_against(const Estimate& right, const Estimate& wrong, Separation& separation) const {
    separation.error = std::min(separation.error, wrong.scores.train);
    separation.seconds = std::max(separation.seconds, seconds_to_tell(wrong, right, like_.predict.window));
  }

  const std::vector<Explanation>& explanations_;
  const Envelope& envelope_;
  const Data& like_;
};

}  // namespace

Suggestions suggest(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                    const std::vector<std::string>& names, const Progress& progress) {
  if (names.size() < 2) {
    throw InputError("--between: found fewer than two effects, expected those that are to be told apart");
  }
  Suggestions suggestions;
  suggestions.explanations = explain(model, catalogue, data, names, progress);
  const Envelope envelope = envelope_of(model, data.trials);
  const Player player(suggestions.explanations, envelope, data);
  const std::size_t count = proposals(model, envelope, 1.0).size();
  for (std::size_t p = 0; p < count; ++p) {
    bool played = false;
    for (double share = 1.0; share > kLeastShare && !played; share *= 0.5) {
      const Proposal proposal = proposals(model, envelope, share)[p];
      progress("playing " + proposal.name, 0.1 + 0.9 * static_cast<double>(p) / static_cast<double>(count));
      Separation separation;
      separation.share = share;
      try {
        played = player.play(proposal, separation);
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
  std::stable_sort(suggestions.experiments.begin(), suggestions.experiments.end(),
                   [](const Separation& a, const Separation& b) {
                     return a.seconds != b.seconds ? a.seconds < b.seconds : a.error > b.error;
                   });
  return suggestions;
}

}  // namespace plumbline::validation
