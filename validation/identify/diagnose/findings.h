// What was tried and chosen, in the words of a diagnosis.
#pragma once

#include <optional>
#include <vector>

#include "validation/identify/diagnose/choose.h"
#include "validation/identify/diagnose/look_ahead.h"

namespace plumbline::validation {

/// Candidates in order of promise, refitted ones first with what they reached and why they are not named.
std::vector<RankRow> ranking_of(const Tried& tried, const Choice& choice, const Data& data,
                                const Policy& policy);

std::vector<PairRow> pair_rows(const std::vector<Pair>& pairs, const Choice& choice);

/// The refit that predicts the held-out windows best at the values that the train windows ask for (without
/// held-out ones, the train windows), if materially better than the stage and with no value at its physical
/// bound.
const Refit* best_predicting(const Stage& stage, const std::vector<const Refit*>& refits, const Data& data,
                             const Policy& policy);

/// The same of what was tried in a round.
std::optional<Unnamed> unnamed_of(const Tried& tried, const Data& data, const Policy& policy);

Named name_of(const Candidate& candidate);

/// The candidate's name. Places that are rigidly tied to its own are its first rivals.
Finding finding_of(const Candidate& candidate);

/// The values of the findings' effects, which are the last ones of the stage's model, with deviations.
void set_values(const Stage& stage, const Data& data, std::vector<Finding>& findings);
/// The same with deviations that are known.
void set_values(const Stage& stage, const Eigen::VectorXd& deviations, std::vector<Finding>& findings);

void set_errors(const Estimate& before, const Estimate& after, Finding& finding);

void add_rival(const Candidate& rival, double correlation, Finding& finding);

/// A rival pair: what it has in place of either effect is that effect's rival.
void add_pair_rivals(const Pair& rival, const Pair& named, double correlation, Finding& first,
                     Finding& second);

}  // namespace plumbline::validation
