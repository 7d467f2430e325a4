#include "validation/identify/diagnose/findings.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "simulator/effects/parameters.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/objection.h"
#include "validation/identify/diagnose/resample.h"
#include "validation/identify/predict/deviations.h"

namespace plumbline::validation {
namespace {

RankRow row_of(const Candidate& candidate) {
  RankRow row;
  row.effect = candidate.law->declaration().name;
  row.at = candidate.at;
  return row;
}

/// Empty where nothing was tried.
std::string why_not_refitted(int candidate, const std::vector<NotRefitted>& failed) {
  const auto found = std::find_if(failed.begin(), failed.end(),
                                  [&](const NotRefitted& one) { return one.candidate == candidate; });
  return found == failed.end() ? "" : "could not be fitted: " + found->reason;
}

/// Structural values of which the law tries more than one, as the side of a stop, or that are fitted once.
std::vector<ParameterValue> chosen_values(const model::EffectUse& use) {
  std::vector<ParameterValue> values;
  const std::vector<effects::Parameter>& parameters = use.law->declaration().parameters;
  const std::vector<effects::Values> starts = use.law->starts({});
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const bool varies = std::any_of(starts.begin(), starts.end(), [&](const effects::Values& start) {
      return start[p] != starts.front()[p];
    });
    if (parameters[p].structural && (varies || effects::is_smoothing_speed(parameters[p]))) {
      values.push_back({parameters[p].name, parameters[p].unit, use.values[p].value, 0.0, true});
    }
  }
  return values;
}

}  // namespace

Named name_of(const Candidate& candidate) { return {candidate.law->declaration().name, candidate.at}; }

std::vector<RankRow> ranking_of(const Tried& tried, const Choice& choice, const Data& data,
                                const Policy& policy) {
  std::vector<RankRow> rows;
  std::vector<bool> done(tried.candidates.size(), false);
  const Role counts = data.has(Role::held_out) ? Role::held_out : Role::train;
  for (std::size_t i = 0; i < tried.refits.size(); ++i) {
    const Refit& refit = tried.refits[i];
    const auto c = static_cast<std::size_t>(refit.candidate);
    done[c] = true;
    RankRow row = row_of(tried.candidates[c]);
    row.score = refit.square();
    row.held_out_after = refit.estimate.predicted.scores.held_out;
    row.train_after = refit.estimate.scores.train;
    row.refitted = true;
    row.remark = choice.objections[i];
    row.selected_share = choice.shares[i];
    std::tie(row.judged_low, row.judged_high) = resampled_error(refit, counts, data, policy);
    rows.push_back(row);
  }
  for (const Hypothesis& hypothesis : tried.hypotheses) {
    const auto c = static_cast<std::size_t>(hypothesis.candidate);
    if (!done[c]) {
      done[c] = true;
      RankRow row = row_of(tried.candidates[c]);
      row.score = hypothesis.promised();
      row.held_out_after = std::sqrt(hypothesis.promised_held_out);
      row.train_after = std::sqrt(hypothesis.promised_train);
      row.remark = why_not_refitted(hypothesis.candidate, tried.failed);
      rows.push_back(row);
    }
  }
  return rows;
}

std::vector<PairRow> pair_rows(const std::vector<Pair>& pairs, const Choice& choice) {
  std::vector<PairRow> rows;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Scores& scores = pairs[i].refit.estimate.predicted.scores;
    rows.push_back({name_of(pairs[i].first), name_of(pairs[i].second), scores.train, scores.held_out,
                    choice.shares[i], choice.objections[i]});
  }
  return rows;
}

const Refit* best_predicting(const Stage& stage, const std::vector<const Refit*>& refits, const Data& data,
                             const Policy& policy) {
  const auto error = [&](const Estimate& estimate) { return judged(estimate.scores, data); };
  const Refit* best = nullptr;
  double least = (1.0 - policy.material) * error(stage.estimate);
  for (const Refit* refit : refits) {
    if (error(refit->estimate) < least && unphysical(*refit).empty()) {
      best = refit;
      least = error(refit->estimate);
    }
  }
  return best;
}

std::optional<Unnamed> unnamed_of(const Tried& tried, const Data& data, const Policy& policy) {
  std::vector<const Refit*> refits;
  for (const Refit& refit : tried.refits) {
    refits.push_back(&refit);
  }
  const Refit* best = best_predicting(tried.stage, refits, data, policy);
  if (best == nullptr) {
    return std::nullopt;
  }
  return Unnamed{{name_of(tried.candidates[static_cast<std::size_t>(best->candidate)])}, after(*best), true};
}

Finding finding_of(const Candidate& candidate) {
  Finding finding;
  finding.effect = candidate.law->declaration().name;
  finding.at = candidate.at;
  finding.equation = candidate.law->declaration().equation;
  for (const std::string& same : candidate.same_places) {
    finding.rivals.push_back({{finding.effect, same}, 1.0, true});
  }
  return finding;
}

void set_values(const Stage& stage, const Data& data, std::vector<Finding>& findings) {
  if (findings.empty()) {
    return;
  }
  PredictorPool pool(stage.model, data);
  set_values(stage,
             precision_of(pool, data.windows_of(Role::train), stage.parameters, stage.estimate).deviations,
             findings);
}

void set_values(const Stage& stage, const Eigen::VectorXd& deviations, std::vector<Finding>& findings) {
  const auto first = static_cast<int>(stage.model.effects.size() - findings.size());
  for (std::size_t f = 0; f < findings.size(); ++f) {
    findings[f].parameters.clear();
    for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
      const FreeParameter& parameter = stage.parameters[p];
      if (parameter.id.effect == first + static_cast<int>(f)) {
        const auto i = static_cast<Eigen::Index>(p);
        findings[f].parameters.push_back({parameter.label.substr(parameter.label.find(':') + 1),
                                          parameter.unit, stage.estimate.theta[i], deviations[i]});
      }
    }
    for (const ParameterValue& value :
         chosen_values(stage.model.effects[static_cast<std::size_t>(first) + f])) {
      findings[f].parameters.push_back(value);
    }
  }
}

void set_errors(const Estimate& before, const Estimate& after, Finding& finding) {
  finding.train_before = before.scores.train;
  finding.held_out_before = before.scores.held_out;
  finding.train_after = after.scores.train;
  finding.held_out_after = after.scores.held_out;
}

void add_rival(const Candidate& rival, double correlation, Finding& finding) {
  const Named name = name_of(rival);
  const bool known = std::any_of(finding.rivals.begin(), finding.rivals.end(), [&](const Rival& other) {
    return other.name.effect == name.effect && other.name.at == name.at;
  });
  if (!known) {
    finding.rivals.push_back({name, correlation, false});
  }
}

void add_pair_rivals(const Pair& rival, const Pair& named, double correlation, Finding& first,
                     Finding& second) {
  const std::string one = rival.first.label();
  const std::string other = rival.second.label();
  if (one == named.first.label()) {
    add_rival(rival.second, correlation, second);
  } else if (other == named.second.label()) {
    add_rival(rival.first, correlation, first);
  } else if (one == named.second.label()) {
    add_rival(rival.second, correlation, first);
  } else if (other == named.first.label()) {
    add_rival(rival.first, correlation, second);
  } else {
    add_rival(rival.first, correlation, first);
    add_rival(rival.second, correlation, second);
  }
}

}  // namespace plumbline::validation
