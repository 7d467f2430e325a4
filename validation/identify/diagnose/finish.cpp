#include "validation/identify/diagnose/finish.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>

#include "validation/identify/diagnose/accept.h"
#include "validation/identify/diagnose/contradicted.h"
#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/revise.h"
#include "validation/identify/predict/carried_states.h"
#include "validation/identify/predict/profile.h"

namespace plumbline::validation {
namespace {

/// The stage without one of its effects, fitted; where it cannot be integrated, with an infinite error. Far
/// above the floor from where the stage has ended: there the way over the windows' beginnings takes minutes,
/// and was gone when the other effects were named.
Stage refitted_without(const Stage& stage, int effect, const Data& data, const Policy& policy) {
  const bool goes_on = !is_below(policy.hopeless, stage.estimate, data);
  const Stage from = goes_on ? Stage{fitted_model(stage), stage.parameters, stage.estimate} : stage;
  Stage rest = without_effect(from, effect);
  try {
    if (!goes_on) {
      return fitted_anew(rest, data);
    }
    PredictorPool pool(rest.model, data);
    rest.estimate =
        gauss_newton(pool, rest.parameters, values_of(rest.model, rest.parameters),
                     carried_states(from.model, rest.model, data, stage.estimate.x0), {10, 1e-4, false});
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    rest.estimate.scores.train = rest.estimate.predicted.scores.held_out =
        std::numeric_limits<double>::infinity();
  }
  return rest;
}

/// Has the search left the law at nothing, exactly?
bool is_nothing(const Stage& stage, std::size_t effect) {
  const model::EffectUse& use = stage.model.effects[effect];
  effects::Values values = use.numbers();
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    if (stage.parameters[p].id.effect == static_cast<int>(effect)) {
      values[static_cast<std::size_t>(stage.parameters[p].id.parameter)] =
          stage.estimate.theta[static_cast<Eigen::Index>(p)];
    }
  }
  return use.law->is_null(values.data());
}

/// Where the last rung is the one before it and this finding, on the same windows, the one before: what the
/// search has left without the finding.
const Stage* before_last(const Finding& finding, const Stage& without, const std::vector<Rung>& ladder) {
  if (ladder.size() < 2 || ladder.back().name != "+ " + finding.label()) {
    return nullptr;
  }
  const Rung& before = ladder[ladder.size() - 2];
  const bool is_same =
      before.length == ladder.back().length && before.stage.parameters.size() == without.parameters.size();
  return is_same ? &before.stage : nullptr;
}

/// The ladder without a finding: an effect that came last goes with its rung.
void take_back(const Finding& finding, const Stage& without, std::vector<Rung>& ladder) {
  if (before_last(finding, without, ladder) == nullptr) {
    ladder.push_back({"- " + finding.label(), without, ladder.back().length});
    return;
  }
  ladder.pop_back();
}

/// Without one finding; `stage` is what is left then.
void drop(std::size_t finding, const Stage& stage, Diagnosis& diagnosis) {
  take_back(diagnosis.accepted[finding], stage, diagnosis.ladder);
  diagnosis.accepted.erase(diagnosis.accepted.begin() + static_cast<std::ptrdiff_t>(finding));
  diagnosis.final_stage = diagnosis.ladder.back().stage;
}

/// What is left without a finding: known where it came last, else fitted.
Stage stage_without(std::size_t finding, const Data& all, const Policy& policy, const Progress& progress,
                    const Diagnosis& diagnosis) {
  const Stage& stage = diagnosis.final_stage;
  const std::vector<Finding>& accepted = diagnosis.accepted;
  const auto effect = static_cast<int>(stage.model.effects.size() - accepted.size() + finding);
  if (const Stage* known = before_last(accepted[finding], without_effect(stage, effect), diagnosis.ladder)) {
    return *known;
  }
  progress("is " + accepted[finding].label() + " still needed", 0.9);
  return refitted_without(stage, effect, all, policy);
}

bool raises_held_out(const Finding& finding) { return finding.held_out_after > finding.held_out_before; }

/// A finding with which the held-out error has risen; else that of whose strength the held-out motion wants
/// the least, if it asks for none of it.
std::optional<std::size_t> most_contradicted(const Data& all, const Diagnosis& diagnosis) {
  constexpr double kNone = 1.0;
  const Stage& stage = diagnosis.final_stage;
  const std::size_t first = stage.model.effects.size() - diagnosis.accepted.size();
  std::optional<std::size_t> most;
  double apart = kNone;
  for (std::size_t i = diagnosis.accepted.size(); i-- > 0;) {
    if (all.has(Role::held_out) && raises_held_out(diagnosis.accepted[i])) {
      return i;
    }
  }
  for (std::size_t i = 0; i < diagnosis.accepted.size(); ++i) {
    const double one = asked_otherwise(stage, static_cast<int>(first + i), all);
    if (one > apart) {
      apart = one;
      most = i;
    }
  }
  return most;
}

/// Beside a name that leaves more unexplained than it explains, what is left decides which law looks best.
/// Squares above the floor, `without` it and with it.
bool explains_most(const Stage& without, const Stage& with, const Data& all) {
  const auto excess = [&](const Stage& stage) {
    const double error = judged(stage.estimate, all);
    return error * error - 1.0;
  };
  return 2.0 * excess(with) <= excess(without);
}

}  // namespace

void drop_superfluous(const Data& all, const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  const std::vector<Finding>& accepted = diagnosis.accepted;
  const auto without = [&](std::size_t i) { return stage_without(i, all, policy, progress, diagnosis); };
  // What helped on the windows on which it was tried, and harms on all, the last first.
  for (std::size_t i = accepted.size(); accepted.size() > 1 && i-- > 0;) {
    const Stage stage = without(i);
    if (judged(stage.estimate, all) < (1.0 - policy.simpler) * judged(diagnosis.final_stage.estimate, all)) {
      drop(i, stage, diagnosis);
    }
  }
  // Against what all of them reach: several small rises would add up.
  const double judged_with_all = judged(diagnosis.final_stage.estimate, all);
  const double train_with_all = diagnosis.final_stage.estimate.scores.train;
  for (std::size_t i = 0; accepted.size() > 1 && i < accepted.size();) {
    const Stage stage = without(i);
    const double rise = std::max(judged(stage.estimate, all) / judged_with_all,
                                 stage.estimate.scores.train / train_with_all) -
                        1.0;
    if (rise < policy.material) {
      drop(i, stage, diagnosis);
    } else {
      ++i;
    }
  }
}

void leave_doubtful_unnamed(const Data& all, const Policy& policy, const Progress& progress,
                            Diagnosis& diagnosis) {
  Unnamed whole{{}, diagnosis.final_stage, true};
  const auto leave_unnamed = [&](std::size_t i, const Stage& without) {
    whole.effects.push_back(diagnosis.accepted[i]);
    drop(i, without, diagnosis);
  };
  for (auto i = most_contradicted(all, diagnosis); i; i = most_contradicted(all, diagnosis)) {
    leave_unnamed(*i, stage_without(*i, all, policy, progress, diagnosis));
  }
  for (std::size_t i = diagnosis.accepted.size(); i-- > 0;) {
    const Stage without = stage_without(i, all, policy, progress, diagnosis);
    if (!explains_most(without, diagnosis.final_stage, all)) {
      leave_unnamed(i, without);
    }
  }
  const double least = std::min(judged(diagnosis.final_stage.estimate.scores, all),
                                diagnosis.unnamed ? judged(diagnosis.unnamed->stage.estimate.scores, all)
                                                  : std::numeric_limits<double>::infinity());
  if (!whole.effects.empty() && judged(whole.stage.estimate.scores, all) < least) {
    diagnosis.unnamed = std::move(whole);
  }
}

bool has_risen(const Data& all, const Diagnosis& diagnosis) {
  return all.has(Role::held_out) &&
         std::any_of(diagnosis.accepted.begin(), diagnosis.accepted.end(), raises_held_out);
}

void settle_values(const Data& all, const Progress& progress, Diagnosis& diagnosis) {
  // Of the cost at the floor, which is about the number of residuals: a step that promises less moves no
  // value by a tenth of its deviation.
  constexpr double kPromise = 0.01;
  constexpr int kIterations = 12;
  double residuals = 0.0;
  for (const int w : all.all_windows()) {
    residuals += readings(all, w);
  }
  progress("the last values", 0.95);
  Stage& stage = diagnosis.final_stage;
  PredictorPool pool(stage.model, all);
  stage.estimate = gauss_newton(pool, stage.parameters, stage.estimate.theta, stage.estimate.x0,
                                {kIterations, kPromise / residuals});
  diagnosis.ladder.back().stage = stage;
}

void hold_values(const Data& all, const Progress& progress, Diagnosis& diagnosis) {
  progress("how well the values are known", 0.97);
  Stage& stage = diagnosis.final_stage;
  const auto first = static_cast<int>(stage.model.effects.size() - diagnosis.accepted.size());
  std::vector<int> named;
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    if (stage.parameters[p].id.effect >= first) {
      named.push_back(static_cast<int>(p));
    }
  }
  PredictorPool pool(stage.model, all);
  const Profiled held = profile(pool, stage.parameters, stage.estimate, named);
  stage.estimate = held.estimate;
  diagnosis.ladder.back().stage = stage;
  diagnosis.precision = held.held;
  set_values(stage, held.held.deviations, diagnosis.accepted);
}

bool take_open_values(const Data& all, Diagnosis& diagnosis) {
  Stage& stage = diagnosis.final_stage;
  const std::size_t first = stage.model.effects.size() - diagnosis.accepted.size();
  bool open = false;
  for (std::size_t i = 0; i < diagnosis.accepted.size(); ++i) {
    diagnosis.accepted[i].open_in_train = is_nothing(stage, first + i);
    open = open || diagnosis.accepted[i].open_in_train;
  }
  if (!open) {
    return false;
  }
  const Prediction predicted = stage.estimate.predicted;
  stage.model = with_values(stage.model, stage.parameters, predicted.theta);
  PredictorPool pool(stage.model, all);
  stage.estimate = estimate_states(pool);
  stage.estimate.theta = predicted.theta;
  stage.estimate.predicted = predicted;
  diagnosis.ladder.back().stage = stage;
  return true;
}

void withdraw_names(const Data& data, const Policy& policy, Diagnosis& diagnosis) {
  diagnosis.withdrawn.assign(diagnosis.accepted.begin(), diagnosis.accepted.end());
  drop_accepted(diagnosis);
  diagnosis.final_stage = diagnosis.ladder.back().stage;
  diagnosis.precision = {};
  diagnosis.unnamed.reset();
  diagnosis.test_after = test_error(fitted_model(diagnosis.final_stage), data);
  conclude(data, policy, diagnosis);
}

void conclude(const Data& data, const Policy& policy, Diagnosis& diagnosis) {
  const double after = judged(diagnosis.final_stage.estimate, data);
  if (diagnosis.accepted.empty()) {
    // The first rungs may be of shorter segments of the windows, on which nothing was missing yet.
    diagnosis.verdict = after < policy.at_floor ? Verdict::nothing_missing : Verdict::unexplained;
    diagnosis.unexplained_share = diagnosis.verdict == Verdict::unexplained ? 1.0 : 0.0;
    return;
  }
  const double before = judged(diagnosis.bare().stage.estimate, data);
  const double excess = before * before - 1.0;
  diagnosis.unexplained_share = excess > 0.0 ? std::clamp((after * after - 1.0) / excess, 0.0, 1.0) : 0.0;
  // Names that leave the error far above the floor are a part of the answer at best.
  diagnosis.verdict = after < policy.finished ? Verdict::missing : Verdict::unexplained;
}

}  // namespace plumbline::validation
