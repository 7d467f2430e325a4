#include "validation/identify/diagnose/diagnose.h"

#include <algorithm>
#include <memory>

#include "simulator/trace/error.h"
#include "validation/identify/diagnose/by_segments.h"
#include "validation/identify/diagnose/diagnoser.h"
#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/pair_step.h"
#include "validation/identify/diagnose/rescore.h"
#include "validation/identify/diagnose/revise.h"
#include "validation/identify/diagnose/same_force.h"
#include "validation/identify/predict/initial_states.h"
#include "validation/identify/predict/kept_results.h"
#include "validation/identify/predict/lost_windows.h"
#include "validation/identify/predict/reach.h"
#include "validation/identify/predict/zero_errors.h"

namespace plumbline::validation {
namespace {

/// On whole windows as far as the model can be followed there.
Followed diagnose_whole(const model::Model& model, const effects::Catalogue& catalogue, Followed followed,
                        const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  Diagnoser diagnoser(catalogue, followed, policy, progress);
  diagnoser.run(model, diagnosis);
  if (diagnosis.verdict == Verdict::unexplained) {
    look_for_pair(diagnoser.first(), catalogue, followed.data, policy, progress, diagnosis);
  }
  return followed;
}

Followed diagnose_windows(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                          const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  progress("how far the model can be followed", 0.0);
  const Followed followed = follow(model, data);
  if (!is_whole(followed)) {
    return diagnose_by_segments(model, catalogue, data, followed, policy, progress, diagnosis);
  }
  if (auto nearer = diagnose_from_nearer(model, catalogue, data, followed, policy, progress, diagnosis)) {
    return std::move(*nearer);
  }
  return diagnose_whole(model, catalogue, followed, policy, progress, diagnosis);
}

/// Fitted values of what is named.
std::size_t named_values(const Diagnosis& diagnosis) {
  const Stage& stage = diagnosis.final_stage;
  const auto first = static_cast<int>(stage.model.effects.size() - diagnosis.accepted.size());
  return static_cast<std::size_t>(
      std::count_if(stage.parameters.begin(), stage.parameters.end(),
                    [&](const FreeParameter& one) { return one.id.effect >= first; }));
}

/// What is said of all windows, where candidates were tried on some.
void finish(const Data& data, const Followed& tried, const Data& some, const Policy& policy,
            const Progress& progress, Diagnosis& diagnosis) {
  const bool is_some = some.windows.size() < data.windows.size();
  const Followed followed =
      is_some ? follow_at(fitted_model(diagnosis.final_stage), data, tried.length) : tried;
  const Data& all = followed.data;
  diagnosis.windows = data.segments(tried.length).windows.size();
  diagnosis.cut_windows = not_followed(data, followed);
  if (is_some) {
    rescore(all, tried.data, policy, progress, diagnosis);
  }
  if (diagnosis.ladder.front().length >=
      diagnosis.ladder.back().length) {  // else they have been tried without
    drop_superfluous(all, policy, progress, diagnosis);
  }
  if (!is_below(policy.finished, diagnosis.final_stage.estimate, all)) {
    leave_doubtful_unnamed(all, policy, progress, diagnosis);
  }
  const bool is_answer =
      !diagnosis.accepted.empty() && is_below(policy.finished, diagnosis.final_stage.estimate, all);
  // Far above the floor each of the refits takes long, and says little of many values.
  constexpr std::size_t kFew = 2;
  const bool is_held =
      is_answer || (!diagnosis.accepted.empty() && !all.has_segments() && named_values(diagnosis) <= kFew);
  if (is_answer) {
    settle_values(all, progress, diagnosis);
  }
  if (is_held) {
    hold_values(all, progress, diagnosis);
  }
  if (take_open_values(all, diagnosis) || !is_held) {
    diagnosis.precision = {};
    set_values(diagnosis.final_stage, all, diagnosis.accepted);
  }
  compare_rungs(data, progress, diagnosis);
  if (!is_answer && has_risen(all, diagnosis)) {  // of the errors that are reported, too
    leave_doubtful_unnamed(all, policy, progress, diagnosis);
    diagnosis.precision = {};
    set_values(diagnosis.final_stage, all, diagnosis.accepted);
    compare_rungs(data, progress, diagnosis);
  }
  conclude(all, policy, diagnosis);
  // What could not be followed has not been explained.
  if (diagnosis.verdict == Verdict::nothing_missing && diagnosis.cut_windows > most_lost(diagnosis.windows)) {
    diagnosis.verdict = Verdict::unexplained;
  }
}

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::missing:
      return "missing";
    case Verdict::nothing_missing:
      return "nothing_missing";
    case Verdict::unexplained:
      break;
  }
  return "unexplained";
}

Diagnosis diagnose(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                   const Policy& policy, const Progress& progress) {
  if (!data.has(Role::train)) {
    throw InputError("found no trial with role: train, expected at least one");
  }
  Diagnosis diagnosis;
  diagnosis.unused_windows = data.unused_windows;
  diagnosis.all_windows = data.windows.size() + data.unused_windows;
  Data kept = without_lost(model, data, diagnosis.lost);
  if (!kept.kept) {
    kept.kept = std::make_shared<KeptResults>();  // some work is asked for in more than one place
  }
  const Data some = kept.thinned(policy.windows);
  try {
    const Followed tried =
        diagnose_windows(with_zero_errors(model, kept), catalogue, some, policy, progress, diagnosis);
    if (is_below(policy.hopeless, diagnosis.final_stage.estimate, tried.data)) {
      name_payloads(catalogue, tried.data, policy, progress, diagnosis);
    }
    finish(kept, tried, some, policy, progress, diagnosis);
    mark_same_forces(fitted_model(diagnosis.final_stage), catalogue, diagnosis.accepted);
    diagnosis.test_before = test_error(model, data);
    diagnosis.test_after = test_error(fitted_model(diagnosis.final_stage), data);
  } catch (const Stopped&) {
    diagnosis.interrupted = true;
    if (!diagnosis.ladder.empty()) {
      conclude(kept, policy, diagnosis);
    }
  }
  return diagnosis;
}

}  // namespace plumbline::validation
