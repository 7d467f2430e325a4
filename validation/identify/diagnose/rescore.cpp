#include "validation/identify/diagnose/rescore.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/predict/carried_states.h"
#include "validation/identify/predict/reach.h"
#include "validation/identify/predict/states_by_parts.h"

namespace plumbline::validation {
namespace {

using States = std::vector<Eigen::VectorXd>;

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
  Estimate second = try_gauss_newton(pool, stage.parameters, from, {}, search);
  if (settled_anew(stage, second, pool.data()) < settled_anew(stage, than, pool.data())) {
    than = std::move(second);
  }
}

/// The states of the windows on which the stage was searched; of the others those of the rung before, as far
/// as the stage's model has them.
States known_states(const Stage& stage, const Data& some, const Stage& before, const Data& all) {
  States x0 = carried_states(fitted_model(before), fitted_model(stage), all, before.estimate.x0);
  if (stage.estimate.x0.size() != some.windows.size()) {
    return x0;
  }
  for (std::size_t s = 0; s < some.windows.size(); ++s) {
    const Window& one = some.windows[s];
    const auto at = std::find_if(all.windows.begin(), all.windows.end(),
                                 [&](const Window& other) { return is_same(one, other); });
    if (at != all.windows.end()) {
      x0[static_cast<std::size_t>(at - all.windows.begin())] = stage.estimate.x0[s];
    }
  }
  return x0;
}

/// Is the error on all windows materially above the one on some of them? Then it may be the beginnings of
/// windows that were not found, and not the law that fails there.
bool is_lost(const Estimate& found, const Data& all, const Stage& stage, const Data& some,
             const Policy& policy) {
  return judged(found, all) > (1.0 + policy.material) * judged(stage.estimate, some);
}

/// Each finding's errors are those of the rung before its own and of its own; where it is the only one that
/// is left, those without anything and of the answer.
void set_errors_of_rungs(Diagnosis& diagnosis) {
  const bool is_left = diagnosis.accepted.size() == 1 && diagnosis.ladder.back().name.rfind("- ", 0) == 0;
  if (is_left && diagnosis.bare().length == diagnosis.ladder.back().length) {
    Finding& one = diagnosis.accepted.front();
    one.train_before = diagnosis.bare().train();
    one.held_out_before = diagnosis.bare().held_out();
    one.train_after = diagnosis.ladder.back().train();
    one.held_out_after = diagnosis.ladder.back().held_out();
    return;
  }
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

/// Values found on some of the windows with which others cannot be integrated explain nothing: the ladder
/// ends before the first rung that has them.
void drop_what_cannot_be_followed(Diagnosis& diagnosis) {
  const auto lost = std::find_if(diagnosis.ladder.begin() + 1, diagnosis.ladder.end(),
                                 [](const Rung& rung) { return !is_finite(rung.stage.estimate); });
  const auto left = static_cast<int>(lost - diagnosis.ladder.begin());
  std::vector<Finding>& accepted = diagnosis.accepted;
  accepted.erase(std::remove_if(accepted.begin(), accepted.end(),
                                [&](const Finding& finding) { return finding.rung >= left; }),
                 accepted.end());
  diagnosis.ladder.erase(lost, diagnosis.ladder.end());
  diagnosis.bare_rungs = std::min(diagnosis.bare_rungs, diagnosis.ladder.size());
}

}  // namespace

// Far above the floor many windows have several minima, and so has the sum of them. Without corners the
// answer's values are sought from two beginnings, and the better is that which still is when its windows are
// settled anew. With corners the way over the windows' beginnings takes minutes, and was gone when the law
// was tried on some of the windows: the search goes on from there. So it does where a search from the
// measurements ends materially above what was reached on some of them.
void rescore(const Data& all, const Data& some, const Policy& policy, const Progress& progress,
             Diagnosis& diagnosis) {
  const double length = diagnosis.ladder.back().length;
  const Rung* before = nullptr;
  for (Rung& rung : diagnosis.ladder) {
    if (rung.length < length) {
      continue;
    }
    progress("all windows for " + rung.name, 0.9);
    PredictorPool pool(rung.stage.model, all);
    const Eigen::VectorXd theta = rung.stage.estimate.theta;
    const bool corners = has_corners(pool, rung.stage.parameters, theta);
    const bool goes_on =
        corners && before != nullptr && !is_below(policy.hopeless, rung.stage.estimate, some);
    const EstimateOptions search{12, 1e-5, !goes_on};  // what the data hardly tell moves last
    const States from = goes_on ? known_states(rung.stage, some, before->stage, all) : States();
    Estimate found = try_gauss_newton(pool, rung.stage.parameters, theta, from, search);
    if (!goes_on && before != nullptr && is_lost(found, all, rung.stage, some, policy)) {
      take_better(try_gauss_newton(pool, rung.stage.parameters, theta,
                                   known_states(rung.stage, some, before->stage, all), {12, 1e-5, false}),
                  found);
    }
    if (before != nullptr) {
      const Estimate& there = before->stage.estimate;
      // What the rung before explains, this one does: else windows have ended in a poorer minimum.
      if (found.scores.train > there.scores.train && have_same_states(there, found)) {
        take_better(try_gauss_newton(pool, rung.stage.parameters, theta, there.x0, search), found);
      }
      if (&rung == &diagnosis.ladder.back() && !is_below(policy.far, found, all) && !corners) {
        const Eigen::VectorXd other = as_before(rung.stage, theta, before->stage);
        take_if_still_better(pool, rung.stage, other, search, found);
      }
    }
    rung.stage.estimate = std::move(found);
    progress(fmt::format("on all windows {}: {:.2f} floors", rung.name, judged(rung.stage.estimate, all)),
             0.9);
    before = &rung;
  }
  drop_what_cannot_be_followed(diagnosis);
  diagnosis.final_stage = diagnosis.ladder.back().stage;
  set_errors_of_rungs(diagnosis);
}

void compare_rungs(const Data& all, const Progress& progress, Diagnosis& diagnosis) {
  const bool are_whole = std::all_of(diagnosis.ladder.begin(), diagnosis.ladder.end(),
                                     [](const Rung& rung) { return std::isinf(rung.length); });
  if (!are_whole) {
    return;
  }
  const auto compare = [&](Rung& rung) {
    progress("all windows for " + rung.name, 0.98);
    PredictorPool pool(fitted_model(rung.stage), all);
    const Estimate anew = estimate_states(pool);
    rung.compared.reset();
    if (is_finite(anew)) {  // else a window is lost with these values: the estimate's own error stands
      rung.compared = anew.scores;
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

}  // namespace plumbline::validation
