#include "validation/diagnose/revise.h"

#include <algorithm>
#include <optional>

#include "validation/diagnose/choose.h"
#include "validation/diagnose/correlation.h"
#include "validation/diagnose/findings.h"
#include "validation/diagnose/resample.h"

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

/// Each rival that is a candidate of its own, refitted in the place of an effect.
std::vector<InPlace> tried_in_place(const Stage& without, const std::vector<Rival>& rivals,
                                    const effects::Catalogue& catalogue, const Data& data,
                                    const DiagnoseOptions& options, const Progress& progress) {
  std::vector<Candidate> candidates;
  {
    PredictorPool pool(without.model, data);
    candidates = list_candidates(pool, catalogue, without.parameters, without.estimate);
  }
  const auto is_no_rival = [&](const Candidate& candidate) {
    return std::none_of(rivals.begin(), rivals.end(),
                        [&](const Rival& rival) { return is_named(candidate, rival.name); });
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_no_rival), candidates.end());
  std::vector<InPlace> tried;
  for (const Refit& one :
       refit(without, candidates, screen(without, candidates, data, progress), data, options, progress)) {
    tried.push_back({candidates[static_cast<std::size_t>(one.candidate)], one});
  }
  return tried;
}

void drop_rival(const Candidate& candidate, Finding& finding) {
  finding.rivals.erase(std::remove_if(finding.rivals.begin(), finding.rivals.end(),
                                      [&](const Rival& rival) { return is_named(candidate, rival.name); }),
                       finding.rivals.end());
}

/// The winner takes the finding's place, at the end of the findings as its effect is at the end of the
/// model's.
void replace(std::size_t index, const InPlace& winner, const Stage& without, double share, const Data& data,
             Diagnosis& diagnosis) {
  const Finding old = diagnosis.accepted[index];
  Finding finding = finding_of(winner.candidate);
  finding.selected_share = share;
  if (1.0 - share > kFair) {
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

void revise_rivals(const effects::Catalogue& catalogue, const Data& data, const DiagnoseOptions& options,
                   const Progress& progress, Diagnosis& diagnosis) {
  const std::size_t count = diagnosis.accepted.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    // Those that were replaced have moved to the end, and need no second look.
    Finding& finding = diagnosis.accepted[i];
    if (finding.rivals.empty()) {
      continue;
    }
    progress("the rivals of " + finding.label(), 0.9);
    const Stage& final_stage = diagnosis.final_stage;
    const auto effect = static_cast<int>(final_stage.model.effects.size() - count + i);
    const Stage without = fitted_anew(without_effect(final_stage, effect), data);
    Refit present;
    present.estimate = final_stage.estimate;
    std::optional<InPlace> winner;
    double share = options.stable;
    for (const InPlace& one : tried_in_place(without, finding.rivals, catalogue, data, options, progress)) {
      const double wins = share_better(one.refit, present, data, options);
      if (wins < kFair) {
        drop_rival(one.candidate, finding);
      } else if (wins > share) {
        winner = one;
        share = wins;
      }
    }
    if (winner) {
      replace(i, *winner, without, share, data, diagnosis);
      return revise_rivals(catalogue, data, options, progress, diagnosis);
    }
  }
}

}  // namespace plumbline::validation
