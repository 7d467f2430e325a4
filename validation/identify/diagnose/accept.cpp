#include "validation/identify/diagnose/accept.h"

#include <algorithm>

#include "validation/identify/diagnose/correlation.h"
#include "validation/identify/diagnose/findings.h"

namespace plumbline::validation {

void accept(const Tried& tried, const Choice& choice, const Data& data, Diagnosis& diagnosis) {
  const Refit& refit = tried.refits[static_cast<std::size_t>(choice.named)];
  const Candidate& candidate = tried.candidates[static_cast<std::size_t>(refit.candidate)];
  const Stage next = after(refit);
  Finding finding = finding_of(candidate);
  finding.selected_share = choice.share;
  for (const std::size_t i : choice.rivals) {
    const Refit& rival = tried.refits[i];
    add_rival(tried.candidates[static_cast<std::size_t>(rival.candidate)],
              correlation(tried.stage, next, after(rival), data), finding);
  }
  set_errors(tried.stage.estimate, refit.estimate, finding);
  finding.rung = static_cast<int>(diagnosis.ladder.size());
  std::vector<Finding> accepted = diagnosis.accepted;
  accepted.push_back(finding);
  set_values(next, data, accepted);
  diagnosis.final_stage = next;  // together with the finding: an interruption comes before both or after
  diagnosis.accepted = accepted;
  diagnosis.ladder.push_back({"+ " + candidate.label(), next, diagnosis.ladder.back().length});
}

void accept_pair(const Tried& tried, const std::vector<Pair>& pairs, const Choice& choice,
                 const Stage& single, const Data& data, Diagnosis& diagnosis) {
  const Pair& pair = pairs[static_cast<std::size_t>(choice.named)];
  const Stage both = after(pair.refit);
  Finding first = finding_of(pair.first);
  Finding second = finding_of(pair.second);
  set_errors(tried.stage.estimate, single.estimate, first);
  set_errors(single.estimate, pair.refit.estimate, second);
  first.selected_share = second.selected_share = choice.share;
  first.together_with = pair.second.label();
  second.together_with = pair.first.label();
  for (const std::size_t i : choice.rivals) {
    add_pair_rivals(pairs[i], pair, correlation(tried.stage, both, after(pairs[i].refit), data), first,
                    second);
  }
  drop_accepted(diagnosis);
  first.rung = static_cast<int>(diagnosis.ladder.size());
  second.rung = first.rung + 1;
  std::vector<Finding> accepted{first, second};
  set_values(both, data, accepted);
  const double length = diagnosis.ladder.back().length;
  diagnosis.ladder.push_back({"+ " + pair.first.label(), single, length});
  diagnosis.final_stage = both;
  diagnosis.ladder.push_back({"+ " + pair.second.label(), both, length});
  diagnosis.accepted = accepted;
}

void accept_group(const Tried& tried, const Group& group, const Data& data, Diagnosis& diagnosis) {
  std::vector<Finding> accepted = diagnosis.accepted;
  for (std::size_t i = 0; i < group.candidates.size(); ++i) {
    Finding finding = finding_of(group.candidates[i]);
    finding.selected_share = group.share;
    finding.rung = static_cast<int>(diagnosis.ladder.size());
    finding.together_with = group.candidates[i == 0 ? 1 : 0].label();
    set_errors(tried.stage.estimate, group.stage.estimate, finding);
    accepted.push_back(std::move(finding));
  }
  set_values(group.stage, data, accepted);
  diagnosis.final_stage = group.stage;
  diagnosis.accepted = accepted;
  const bool is_friction = std::all_of(
      group.candidates.begin(), group.candidates.end(),
      [](const Candidate& one) { return dynamic_cast<const effects::ForceLaw*>(one.law.get()) != nullptr; });
  const std::string count = std::to_string(group.candidates.size());
  diagnosis.ladder.push_back(
      {is_friction ? "+ friction at " + count + " places" : "+ " + count + " effects of friction and drives",
       group.stage, diagnosis.ladder.back().length});
}

void drop_accepted(Diagnosis& diagnosis) {
  diagnosis.accepted.clear();
  diagnosis.ladder.resize(diagnosis.bare_rungs);
}

}  // namespace plumbline::validation
