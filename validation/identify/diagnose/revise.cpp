#include "validation/identify/diagnose/revise.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

#include "validation/identify/diagnose/choose.h"
#include "validation/identify/diagnose/correlation.h"
#include "validation/identify/diagnose/family.h"
#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/objection.h"
#include "validation/identify/diagnose/resample.h"

namespace plumbline::validation {
namespace {

bool is_named(const Candidate& candidate, const Named& name) {
  return candidate.law->declaration().name == name.effect && candidate.at == name.at;
}

/// A rival in a finding's place, with all other findings in the model.
struct InPlace {
  Candidate candidate;
  Refit refit;
};

/// Is it a rival, or a law of fewer constants at a rival's place, which the rival may contain and owe what it
/// explains?
bool is_asked(const Candidate& candidate, const std::vector<Candidate>& all,
              const std::vector<Rival>& rivals) {
  return std::any_of(rivals.begin(), rivals.end(), [&](const Rival& rival) {
    if (is_named(candidate, rival.name)) {
      return true;
    }
    const auto of_rival =
        std::find_if(all.begin(), all.end(), [&](const Candidate& one) { return is_named(one, rival.name); });
    return of_rival != all.end() && candidate.place == of_rival->place && candidate.at == of_rival->at &&
           is_friction(*candidate.law) && is_friction(*of_rival->law) &&
           candidate.law->parameter_count() < of_rival->law->parameter_count();
  });
}

/// A finding in question: what is left without it, fitted, and the answer with it.
struct InQuestion {
  Stage without;
  Refit present;
};

InQuestion in_question(std::size_t finding, const Data& data, const Diagnosis& diagnosis) {
  const Stage& stage = diagnosis.final_stage;
  const std::vector<model::EffectUse>& uses = stage.model.effects;
  const Finding& asked_of = diagnosis.accepted[finding];
  const auto use = std::find_if(uses.rbegin(), uses.rend(), [&](const model::EffectUse& one) {
    return one.at == asked_of.at && one.law->declaration().name == asked_of.effect;
  });
  if (use == uses.rend()) {
    throw std::logic_error(asked_of.label() + " was named and is not in the model");
  }
  const auto effect = static_cast<int>(uses.rend() - use) - 1;
  InQuestion asked{fitted_anew(without_effect(stage, effect), data), {}};
  asked.present.estimate = stage.estimate;
  return asked;
}

/// Each rival that is a candidate of its own, refitted in the place of an effect, and what it may contain.
std::vector<InPlace> tried_in_place(const Stage& without, const std::vector<Rival>& rivals,
                                    const effects::Catalogue& catalogue, const Data& data,
                                    const Policy& policy, const Progress& progress) {
  std::vector<Candidate> candidates;
  {
    PredictorPool pool(without.model, data);
    candidates = list_candidates(pool, catalogue, without.parameters, without.estimate);
  }
  std::vector<Candidate> asked;
  std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(asked),
               [&](const Candidate& candidate) { return is_asked(candidate, candidates, rivals); });
  candidates = std::move(asked);
  std::vector<InPlace> tried;
  for (const Refit& one :
       refit(without, candidates, screen(without, candidates, data, progress), data, policy, progress)) {
    tried.push_back({candidates[static_cast<std::size_t>(one.candidate)], one});
  }
  return tried;
}

/// Of those nearly as good as the best the one of the fewest fitted parameters, then of the fewest constants.
const InPlace& simplest_near_best(const std::vector<InPlace>& better, const Policy& policy) {
  const auto square = [](const InPlace& one) { return one.refit.square(); };
  const double best =
      square(*std::min_element(better.begin(), better.end(),
                               [&](const InPlace& a, const InPlace& b) { return square(a) < square(b); }));
  const double near = (1.0 + policy.simpler) * (1.0 + policy.simpler) * best;
  const auto complexity = [&](const InPlace& one) {
    return std::make_tuple(square(one) > near, one.refit.own, one.candidate.law->parameter_count(),
                           square(one));
  };
  return *std::min_element(better.begin(), better.end(),
                           [&](const InPlace& a, const InPlace& b) { return complexity(a) < complexity(b); });
}

/// How far the model's numbers are from what is stated of them, in squared deviations.
double strain_of(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta) {
  return prior(parameters, search_units(parameters, theta), theta).square;
}

void drop_rival(const Candidate& candidate, Finding& finding) {
  finding.rivals.erase(std::remove_if(finding.rivals.begin(), finding.rivals.end(),
                                      [&](const Rival& rival) { return is_named(candidate, rival.name); }),
                       finding.rivals.end());
}

/// The winner takes the finding's place, at the end of the findings as its effect is at the end of the
/// model's.
void replace(std::size_t index, const InPlace& winner, const Stage& without, double share, const Data& data,
             const Policy& policy, Diagnosis& diagnosis) {
  const Finding old = diagnosis.accepted[index];
  Finding finding = finding_of(winner.candidate);
  finding.selected_share = share;
  finding.in_place_of = old.label();
  if (1.0 - share > policy.fair) {
    finding.rivals.push_back({{old.effect, old.at},
                              correlation(without, after(winner.refit), diagnosis.final_stage, data),
                              false});
  }
  set_errors(without.estimate, winner.refit.estimate, finding);
  finding.rung = static_cast<int>(diagnosis.ladder.size());
  std::vector<Finding> accepted = diagnosis.accepted;
  accepted.erase(accepted.begin() + static_cast<std::ptrdiff_t>(index));
  accepted.push_back(finding);
  const Stage next = after(winner.refit);
  set_values(next, data, accepted);
  diagnosis.ladder.push_back(
      {winner.candidate.label() + " for " + old.label(), next, diagnosis.ladder.back().length});
  diagnosis.final_stage = next;
  diagnosis.accepted = accepted;
}

}  // namespace

Stage without_effect(const Stage& stage, int effect) {
  Stage without = stage;
  without.model.effects.erase(without.model.effects.begin() + effect);
  without.parameters.clear();
  for (FreeParameter parameter : stage.parameters) {
    if (parameter.id.effect == effect) {
      continue;
    }
    parameter.id.effect -= parameter.id.effect > effect ? 1 : 0;
    without.parameters.push_back(parameter);
  }
  return without;
}

void revise_rivals(const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
                   const Progress& progress, Diagnosis& diagnosis) {
  const std::size_t count = diagnosis.accepted.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    // Those that were replaced have moved to the end, and need no second look.
    Finding& finding = diagnosis.accepted[i];
    if (finding.rivals.empty()) {
      continue;
    }
    progress("the rivals of " + finding.label(), 0.9);
    const auto [without, present] = in_question(i, data, diagnosis);
    std::vector<InPlace> better;
    for (InPlace& one : tried_in_place(without, finding.rivals, catalogue, data, policy, progress)) {
      const double wins = share_better(one.refit, present, data, policy);
      if (wins < policy.fair) {
        drop_rival(one.candidate, finding);
      } else if (wins > policy.stable && judged(one.refit.estimate, data) <= judged(present.estimate, data)) {
        better.push_back(std::move(one));
      }
    }
    if (!better.empty()) {
      const InPlace& winner = simplest_near_best(better, policy);
      replace(i, winner, without, share_better(winner.refit, present, data, policy), data, policy, diagnosis);
      return revise_rivals(catalogue, data, policy, progress, diagnosis);
    }
  }
}

void name_payloads(const effects::Catalogue& catalogue, const Data& data, const Policy& policy,
                   const Progress& progress, Diagnosis& diagnosis) {
  const std::size_t count = diagnosis.accepted.size();
  const double near = std::pow(1.0 + policy.simpler, 2);
  for (std::size_t i = 0; i < count; ++i) {
    const Finding finding = diagnosis.accepted[i];
    if (!may_be_payload(finding.effect)) {
      continue;
    }
    progress("a payload for " + finding.label(), 0.9);
    const auto [without, present] = in_question(i, data, diagnosis);
    const Stage& named = diagnosis.final_stage;
    const double strain = strain_of(named.parameters, named.estimate.theta);
    const std::vector<Rival> payload{{{"payload", finding.at}, 0.0, false}};
    for (const InPlace& one : tried_in_place(without, payload, catalogue, data, policy, progress)) {
      const double wins = share_better(one.refit, present, data, policy);
      const double more = strain_of(one.refit.extended.parameters, one.refit.estimate.theta) - strain;
      const bool is_believable = std::exp(-0.5 * more) >= policy.fair;
      if (wins >= policy.fair && is_believable && one.refit.square() < near * present.square() &&
          refusal(without, one.refit, data, policy).empty()) {
        replace(i, one, without, wins * finding.selected_share, data, policy, diagnosis);
        return name_payloads(catalogue, data, policy, progress, diagnosis);
      }
    }
  }
}

}  // namespace plumbline::validation
