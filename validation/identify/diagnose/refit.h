// Nested refits of the best candidates.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/diagnose/tangents.h"

namespace plumbline::validation {

/// Relative change of the squared error at which a refit's search ends: what is nearer is the same.
constexpr double kRefitTolerance = 2e-3;

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

/// A candidate that could not be refitted, and why.
struct NotRefitted {
  int candidate = 0;
  std::string reason;
};

/// Best first; what is equal stays in its order.
void sort_by_error(std::vector<Refit>& refits);

/// Refits the best hypotheses: a short refit of all, a full one of those that stay near the best, and beside
/// the best one the simpler laws of its place, one of which it may contain. Those that fail are told to
/// `failed`, if there is one.
std::vector<Refit> refit(const Stage& stage, const std::vector<Candidate>& candidates,
                         const std::vector<Hypothesis>& hypotheses, const Data& data, const Policy& policy,
                         const Progress& progress, std::vector<NotRefitted>* failed = nullptr);

/// Two candidates at once, from what was promised of them together.
Refit refit_pair(const Stage& stage, const Candidate& first, const Candidate& second,
                 const PairHypothesis& promise, const Data& data);

/// The stage that a refit leads to.
Stage after(const Refit& refit);

}  // namespace plumbline::validation
