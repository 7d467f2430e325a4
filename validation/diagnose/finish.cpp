#include "validation/diagnose/finish.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "validation/diagnose/findings.h"
#include "validation/diagnose/judged.h"
#include "validation/diagnose/revise.h"
#include "validation/predict/profile.h"
#include "validation/predict/states_by_parts.h"

namespace plumbline::validation {
namespace {

/// Fitted anew; where it cannot be integrated, with an infinite error.
Stage unless_lost(const Stage& stage, const Data& data) {
  try {
    return fitted_anew(stage, data);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    Stage lost = stage;
    lost.estimate.scores.train = lost.estimate.predicted.scores.held_out =
        std::numeric_limits<double>::infinity();
    return lost;
  }
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

bool have_same_states(const Estimate& one, const Estimate& other) {
  return std::equal(one.x0.begin(), one.x0.end(), other.x0.begin(), other.x0.end(),
                    [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) { return a.size() == b.size(); });
}

/// The values of a stage; those that the rung before has, too, as they are there.
Eigen::VectorXd as_before(const Stage& stage, Eigen::VectorXd theta, const Stage& before) {
  for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
    for (std::size_t q = 0; q < before.parameters.size(); ++q) {
      if (stage.parameters[p].label == before.parameters[q].label) {
        theta[static_cast<Eigen::Index>(p)] = before.estimate.theta[static_cast<Eigen::Index>(q)];
      }
    }
  }
  return theta;
}

void take_better(Estimate other, Estimate& than) {
  if (other.cost < than.cost) {
    than = std::move(other);
  }
}

/// The train error that `compare` would give of the stage with these values.
double settled_anew(Stage stage, const Estimate& estimate, const Data& data) {
  stage.estimate = estimate;
  PredictorPool pool(fitted_model(stage), data);
  return estimate_states(pool).scores.train;
}

/// What a second search of the same stage from these values finds, if that is better once the windows are
/// settled anew. Where it cannot be followed it is not.
void take_if_still_better(PredictorPool& pool, const Stage& stage, const Eigen::VectorXd& from,
                          const EstimateOptions& search, Estimate& than) {
  try {
    Estimate second = gauss_newton(pool, stage.parameters, from, {}, search);
    if (settled_anew(stage, second, pool.data()) < settled_anew(stage, than, pool.data())) {
      than = std::move(second);
    }
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return;
  }
}

/// Each finding's errors are those of the rung before its own and of its own.
void set_errors_of_rungs(Diagnosis& diagnosis) {
  for (Finding& finding : diagnosis.accepted) {
    const auto r = static_cast<std::size_t>(std::max(finding.rung, 0));
    if (r == 0 || r >= diagnosis.ladder.size() ||
        diagnosis.ladder[r].length != diagnosis.ladder[r - 1].length) {
      continue;
    }
    finding.train_before = diagnosis.ladder[r - 1].train();
    finding.held_out_before = diagnosis.ladder[r - 1].held_out();
    finding.train_after = diagnosis.ladder[r].train();
    finding.held_out_after = diagnosis.ladder[r].held_out();
  }
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

}  // namespace

void compare_rungs(const Data& all, const Progress& progress, Diagnosis& diagnosis) {
  const bool are_whole = std::all_of(diagnosis.ladder.begin(), diagnosis.ladder.end(),
                                     [](const Rung& rung) { return std::isinf(rung.length); });
  if (!are_whole) {
    return;
  }
  const auto compare = [&](Rung& rung) {
    progress("all windows for " + rung.name, 0.98);
    PredictorPool pool(fitted_model(rung.stage), all);
    try {
      rung.compared = estimate_states(pool).scores;
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      rung.compared.reset();  // a window is lost with these values: the estimate's own error stands
    }
  };
  // Where the answer's windows settle anew as they did before, those of the rungs before it have, too.
  constexpr double kSame = 0.01;
  Rung& answer = diagnosis.ladder.back();
  compare(answer);
  const Scores& before = answer.stage.estimate.scores;
  if (!answer.compared || std::abs(answer.compared->train - before.train) > kSame * before.train ||
      std::abs(answer.compared->held_out - before.held_out) > kSame * before.held_out) {
    std::for_each(diagnosis.ladder.begin(), diagnosis.ladder.end() - 1, compare);
  }
  set_errors_of_rungs(diagnosis);
}

// Far above the floor many windows have several minima, and so has the sum of them: the answer's values are
// sought from two beginnings, and the better is that which still is when its windows are settled anew. With
// corners every search goes by way of the windows' beginnings already, and takes minutes.
void rescore(const Data& all, const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  const double length = diagnosis.ladder.back().length;
  const Rung* before = nullptr;
  for (Rung& rung : diagnosis.ladder) {
    if (rung.length < length) {
      continue;
    }
    progress("all windows for " + rung.name, 0.9);
    PredictorPool pool(rung.stage.model, all);
    const EstimateOptions search{12, 1e-5};  // what the data hardly tell moves last
    const Eigen::VectorXd theta = rung.stage.estimate.theta;
    Estimate found = gauss_newton(pool, rung.stage.parameters, theta, {}, search);
    if (before != nullptr) {
      const Estimate& there = before->stage.estimate;
      // What the rung before explains, this one does: else windows have ended in a poorer minimum.
      if (found.scores.train > there.scores.train && have_same_states(there, found)) {
        take_better(gauss_newton(pool, rung.stage.parameters, theta, there.x0, search), found);
      }
      if (&rung == &diagnosis.ladder.back() && !is_below(policy.far, found, all) &&
          !has_corners(pool, rung.stage.parameters, theta)) {
        const Eigen::VectorXd other = as_before(rung.stage, theta, before->stage);
        take_if_still_better(pool, rung.stage, other, search, found);
      }
    }
    rung.stage.estimate = std::move(found);
    before = &rung;
  }
  diagnosis.final_stage = diagnosis.ladder.back().stage;
  set_errors_of_rungs(diagnosis);
}

void drop_superfluous(const Data& all, const Policy& policy, const Progress& progress, Diagnosis& diagnosis) {
  std::vector<Finding>& accepted = diagnosis.accepted;
  const auto without = [&](std::size_t i) {
    const Stage& stage = diagnosis.final_stage;
    const auto effect = static_cast<int>(stage.model.effects.size() - accepted.size() + i);
    const Stage rest = without_effect(stage, effect);
    if (const Stage* known = before_last(accepted[i], rest, diagnosis.ladder)) {
      return *known;
    }
    progress("is " + accepted[i].label() + " still needed", 0.9);
    return unless_lost(rest, all);
  };
  const auto drop = [&](std::size_t i, const Stage& stage) {
    take_back(accepted[i], stage, diagnosis.ladder);
    accepted.erase(accepted.begin() + static_cast<std::ptrdiff_t>(i));
    diagnosis.final_stage = diagnosis.ladder.back().stage;
  };
  // What helped on the windows on which it was tried, and harms on all, the last first.
  for (std::size_t i = accepted.size(); accepted.size() > 1 && i-- > 0;) {
    const Stage stage = without(i);
    if (judged(stage.estimate, all) < (1.0 - policy.simpler) * judged(diagnosis.final_stage.estimate, all)) {
      drop(i, stage);
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
      drop(i, stage);
    } else {
      ++i;
    }
  }
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

void conclude(const Data& data, const Policy& policy, Diagnosis& diagnosis) {
  const double after = judged(diagnosis.final_stage.estimate, data);
  if (diagnosis.accepted.empty()) {
    // The first rungs may be of shorter segments of the windows, on which nothing was missing yet.
    diagnosis.verdict = after < policy.nothing ? Verdict::nothing_missing : Verdict::unexplained;
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
