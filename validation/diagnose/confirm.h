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
  bool is_full = false;    ///< has been refitted as far as it will be
  /// Mean squares of train and of held-out as foretold, floor units: what refits are compared by.
  double square() const { return estimate.predicted.scores.square(); }
};

/// Best first; what is equal stays in its order.
void sort_by_error(std::vector<Refit>& refits);

/// Refits the best hypotheses: a short refit of all, a full one of those that stay near the best.
std::vector<Refit> refit(const Stage& stage, const std::vector<Candidate>& candidates,
                         const std::vector<Hypothesis>& hypotheses, const Data& data,
                         const DiagnoseOptions& options, const Progress& progress);

/// Two candidates at once, from what was promised of them together.
Refit refit_pair(const Stage& stage, const Candidate& first, const Candidate& second,
                 const PairHypothesis& promise, const Data& data);

/// The stage that a refit leads to.
Stage after(const Refit& refit);

/// For each refit the share of block resamples (windows drawn with replacement) in which it is the best of
/// the `contenders`; the stage itself stands for "none" and wins unless a refit is material. Last entry: the
/// share of "none".
std::vector<double> selected_shares(const Stage& stage, const std::vector<Refit>& refits,
                                    const std::vector<std::size_t>& contenders, const Data& data,
                                    const DiagnoseOptions& options);

/// Between which values 90 % of the resamples have the error of one role, in units of the floor.
std::pair<double, double> resampled_error(const Refit& refit, Role role, const Data& data,
                                          const DiagnoseOptions& options);

/// Share of resamples in which `other` predicts better than `best`.
double share_better(const Refit& other, const Refit& best, const Data& data, const DiagnoseOptions& options);

/// Why a refit cannot be the law that it claims, whatever the others do, in a few words: a value at its
/// bound, or one that cannot be told from no effect. Empty when nothing is wrong with it.
std::string flaw(const Refit& refit, const Data& data);

/// Why a refit without a flaw may not be accepted; empty when it may.
std::string objection(const Stage& stage, const Refit& refit, double share, const Data& data,
                      const DiagnoseOptions& options);

}  // namespace plumbline::validation
