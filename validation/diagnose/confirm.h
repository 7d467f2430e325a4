// Nested refits of the best candidates, and the judgement of what they bring.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "validation/diagnose/diagnose.h"
#include "validation/diagnose/tangents.h"

namespace plumbline::validation {

/// A candidate, or two of them, refitted nonlinearly on the train windows.
struct Refit {
  int candidate = 0;
  Extended extended;
  Estimate estimate;
  std::vector<int> added;  ///< the candidates' effects in the extended model
  int own = 0;             ///< number of their parameters (the last ones)
  double square() const {
    return estimate.scores.train * estimate.scores.train +
           estimate.scores.held_out * estimate.scores.held_out;
  }
};

/// Refits the best hypotheses: a short refit of all, a full one of those that stay near the best.
std::vector<Refit> refit(const Stage& stage, const std::vector<Candidate>& candidates,
                         const std::vector<Hypothesis>& hypotheses, const Data& data,
                         const DiagnoseOptions& options, const Progress& progress);

/// Two candidates at once, from what was promised of them together.
Refit refit_pair(const Stage& stage, const Candidate& first, const Candidate& second,
                 const PairHypothesis& promise, const Data& data);

/// The stage that a refit leads to.
Stage after(const Refit& refit);

/// For each refit the share of block resamples (windows drawn with replacement) in which it is the best; the
/// stage itself stands for "none" and wins unless a refit is material. Last entry: the share of "none".
std::vector<double> selected_shares(const Stage& stage, const std::vector<Refit>& refits, const Data& data,
                                    const DiagnoseOptions& options);

/// Between which values 90 % of the resamples have the error of one role, in units of the floor.
std::pair<double, double> resampled_error(const Refit& refit, Role role, const Data& data,
                                          const DiagnoseOptions& options);

/// Share of resamples in which `other` predicts better than `best`.
double share_better(const Refit& other, const Refit& best, const Data& data, const DiagnoseOptions& options);

/// Empty when the refit may be accepted, otherwise the reason in a few words.
std::string objection(const Stage& stage, const Refit& refit, double share, const Data& data,
                      const DiagnoseOptions& options);

}  // namespace plumbline::validation
