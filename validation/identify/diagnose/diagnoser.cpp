#include "validation/identify/diagnose/diagnoser.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "validation/identify/diagnose/accept.h"
#include "validation/identify/diagnose/choose.h"
#include "validation/identify/diagnose/findings.h"
#include "validation/identify/diagnose/finish.h"
#include "validation/identify/diagnose/judged.h"
#include "validation/identify/diagnose/one_place.h"
#include "validation/identify/diagnose/own_parameters.h"
#include "validation/identify/diagnose/promise.h"
#include "validation/identify/diagnose/refit_one.h"
#include "validation/identify/diagnose/revise.h"

namespace plumbline::validation {
namespace {

/// Rung::length.
double length_of(const Followed& followed) {
  return is_whole(followed) ? std::numeric_limits<double>::infinity() : followed.length;
}

/// Have most of the model's own numbers gone as far as what is stated of them lets them? Then they make up
/// for something that is not there.
bool most_are_at_limits(const Stage& stage, double width) {
  constexpr double kAlmost = 0.999;
  const std::vector<OwnParameter> own = own_values(stage);
  const auto at_limits = std::count_if(own.begin(), own.end(), [&](const OwnParameter& one) {
    return std::abs(one.shift()) >= kAlmost * width;
  });
  return 2 * static_cast<std::size_t>(at_limits) > own.size();
}

}  // namespace

Diagnoser::Diagnoser(const effects::Catalogue& catalogue, const Followed& followed, const Policy& policy,
                     const Progress& progress)
    : catalogue_(catalogue),
      data_(followed.data),
      x0_(followed.x0),
      length_(length_of(followed)),
      policy_(policy),
      progress_(progress) {}

void Diagnoser::run(const model::Model& model, Diagnosis& diagnosis) {
  start(model, diagnosis);
  const Rung given = diagnosis.ladder.front();
  const Stage open = opened(given.stage);
  if (open.parameters.empty()) {
    look(policy_.most_effects, diagnosis);
  } else {
    look_with_own_numbers(given, {"model parameters fitted", fit_own(open), length_}, diagnosis);
  }
}

bool Diagnoser::begin_on_segments(const model::Model& model, Diagnosis& diagnosis) {
  start(model, diagnosis);
  const Rung given = diagnosis.ladder.front();
  const Stage open = opened(given.stage);
  if (open.parameters.empty()) {
    return true;
  }
  const bool promising = promises_much(open);
  if (promising) {
    restart({given, {"model parameters fitted", fit_own(open), length_}}, diagnosis);
  }
  return promising;
}

bool Diagnoser::further_on(bool complete, bool with_numbers, Diagnosis& diagnosis) {
  progress_(std::isinf(length_) ? "whole windows" : fmt::format("windows of {:.2g} s", length_), 0.0);
  const Stage& before = diagnosis.final_stage;
  take("the same on longer windows", fitted_anew({fitted_model(before), before.parameters, {}}, data_, x0_),
       diagnosis);
  const bool at_floor = is_below(policy_.at_floor, diagnosis.final_stage.estimate, data_);
  const bool helped = !(at_floor && complete) && with_numbers && open_own_numbers(diagnosis);
  if (diagnosis.accepted.empty()) {
    diagnosis.bare_rungs = diagnosis.ladder.size();
  }
  return at_floor || helped;
}

void Diagnoser::look_further(bool in_any_case, Diagnosis& diagnosis) {
  look(policy_.most_effects - static_cast<int>(diagnosis.accepted.size()), diagnosis, in_any_case);
}

void Diagnoser::start(const model::Model& model, Diagnosis& diagnosis) {
  progress_("the model as given", 0.0);
  Stage& stage = diagnosis.final_stage;
  stage.model = model;
  PredictorPool pool(model, data_);
  const Estimate given = estimate_states(pool, x0_);
  diagnosis.ladder.push_back({"as given", {model, {}, given}, length_});
  stage.estimate = given;
}

Stage Diagnoser::opened(const Stage& given) const {
  return is_below(policy_.at_floor, given.estimate, data_)
             ? given
             : with_open_numbers(given, 0, policy_.parameter_width, data_);
}

double Diagnoser::enough() const { return std::isinf(length_) ? policy_.at_floor : policy_.finished; }

/// So far above the floor, behind a stop or play that was just named, each candidate is searched through its
/// contacts, and what is named there seldom stands on all windows.
bool Diagnoser::is_costly(const Diagnosis& diagnosis) const {
  const Stage& stage = diagnosis.final_stage;
  return !diagnosis.accepted.empty() && jumps(fitted_model(stage).effects.back()) &&
         !is_below(policy_.hopeless, stage.estimate, data_);
}

void Diagnoser::look(int most, Diagnosis& diagnosis, bool in_any_case, bool with_numbers) {
  for (int round = 0; round < most; ++round) {
    if (with_numbers && round > 0 && !is_below(enough(), diagnosis.final_stage.estimate, data_)) {
      open_own_numbers(diagnosis);
    }
    const Estimate& now = diagnosis.final_stage.estimate;
    const bool is_needed = (in_any_case && round == 0) || !is_below(enough(), now, data_);
    if (!is_needed || !is_finite(now) || is_costly(diagnosis) || !step(diagnosis, round)) {
      break;
    }
  }
  // Where hundreds of floors remain, which of two rivals is nearer is decided by what is not in the model.
  if (is_below(policy_.hopeless, diagnosis.final_stage.estimate, data_)) {
    revise_rivals(catalogue_, data_, policy_, progress_, diagnosis);
  }
  conclude(data_, policy_, diagnosis);
}

void Diagnoser::restart(const std::vector<Rung>& ladder, Diagnosis& diagnosis) {
  Diagnosis anew;
  anew.lost = std::move(diagnosis.lost);
  anew.ladder = ladder;
  anew.bare_rungs = ladder.size();
  anew.final_stage = ladder.back().stage;
  diagnosis = std::move(anew);
}

void Diagnoser::look_with_own_numbers(const Rung& given, const Rung& fitted, Diagnosis& diagnosis) {
  if (judged(fitted.stage.estimate, data_) > (1.0 + policy_.material) * judged(given.stage.estimate, data_)) {
    // Values that do not hold on the other motion are none of the robot, but stand in for something larger.
    // Beside that they are asked again.
    constexpr bool kInAnyCase = false, kWithNumbers = true;
    look(policy_.most_effects, diagnosis, kInAnyCase, kWithNumbers);
    return;
  }
  if (!helps(given, fitted)) {
    look_as_stated_first(given, fitted, diagnosis);
    return;
  }
  restart({given, fitted}, diagnosis);
  look(policy_.most_effects, diagnosis);
  if (diagnosis.verdict == Verdict::unexplained ||
      (diagnosis.verdict == Verdict::missing && evidence(diagnosis) < -std::log(policy_.evidence))) {
    return;
  }
  Tried first = std::move(first_);
  Diagnosis stated;
  stated.lost = diagnosis.lost;
  restart({given}, stated);
  look(policy_.most_as_stated, stated);
  if (speaks_for_stated(stated)) {
    diagnosis = std::move(stated);
  } else {
    first_ = std::move(first);
  }
}

// Where the data do not speak for the stated numbers both ways are gone, and prediction decides.
void Diagnoser::look_as_stated_first(const Rung& given, const Rung& fitted, Diagnosis& diagnosis) {
  look(policy_.most_as_stated, diagnosis);
  if (speaks_for_stated(diagnosis)) {
    return;
  }
  Diagnosis stated = std::move(diagnosis);
  Tried first = std::move(first_);
  diagnosis = {};
  diagnosis.lost = stated.lost;
  restart({given, fitted}, diagnosis);
  const auto stated_is_better = [&] {
    return !stated.accepted.empty() &&
           judged(stated.final_stage.estimate, data_) < judged(diagnosis.final_stage.estimate, data_);
  };
  try {
    look(policy_.most_effects, diagnosis);
  } catch (const Stopped&) {  // what was found is not lost
    if (stated_is_better()) {
      diagnosis = std::move(stated);
    }
    throw;
  }
  if (stated_is_better()) {
    diagnosis = std::move(stated);
    first_ = std::move(first);
    look(policy_.most_effects - static_cast<int>(diagnosis.accepted.size()), diagnosis);
  }
}

bool Diagnoser::helps(const Rung& given, const Rung& fitted) const {
  const double before = judged(given.stage.estimate, data_);
  return before > policy_.finished && judged(fitted.stage.estimate, data_) < before &&
         !most_are_at_limits(fitted.stage, policy_.parameter_width);
}

double Diagnoser::evidence(const Diagnosis& diagnosis) const {
  return evidence_for_stated(diagnosis.final_stage, data_, policy_.parameter_width);
}

bool Diagnoser::speaks_for_stated(const Diagnosis& diagnosis) const {
  return diagnosis.verdict == Verdict::nothing_missing ||
         (diagnosis.verdict == Verdict::missing && evidence(diagnosis) > std::log(policy_.evidence));
}

bool Diagnoser::open_own_numbers(Diagnosis& diagnosis) const {
  const Stage& stage = diagnosis.final_stage;
  const Stage open = with_open_numbers(stage, diagnosis.accepted.size(), policy_.parameter_width, data_);
  // Twice: what is judged is the error, what is promised its square.
  if (open.parameters.size() == stage.parameters.size() || !promises_much(open, 2.0 * policy_.simpler)) {
    return false;
  }
  const Stage fitted = fit_own(open);
  const bool helps = judged(fitted.estimate, data_) < (1.0 - policy_.simpler) * judged(stage.estimate, data_);
  if (helps) {
    take("model parameters fitted", fitted, diagnosis);
  }
  return helps;
}

void Diagnoser::take(const std::string& name, const Stage& stage, Diagnosis& diagnosis) const {
  diagnosis.ladder.push_back({name, stage, length_});
  replace_last(stage, diagnosis);
}

void Diagnoser::replace_last(const Stage& stage, Diagnosis& diagnosis) const {
  set_values(stage, data_, diagnosis.accepted);
  diagnosis.final_stage = stage;
  diagnosis.ladder.back().stage = stage;
}

bool Diagnoser::promises_much(const Stage& open, double least) const {
  const LinearProblem problem =
      linear_problem(open.model, open.parameters, values_of(open.model, open.parameters), data_,
                     data_.all_windows(), open.estimate.x0);
  const double before = problem.train.sse / problem.train.samples;
  return before - promise_of(problem).train > std::max(policy_.material * (before - 1.0), least * before);
}

Stage Diagnoser::fit_own(const Stage& open) const {
  progress_("the model parameters", 0.0);
  constexpr double kTolerance = 1e-4;
  return fitted_anew(open, data_, open.estimate.x0, kTolerance);
}

std::vector<std::string> Diagnoser::names_of(const std::vector<Finding>& findings) {
  std::vector<std::string> names;
  names.reserve(findings.size());
  for (const Finding& finding : findings) {
    names.push_back(finding.label());
  }
  return names;
}

bool Diagnoser::step(Diagnosis& diagnosis, int round) {
  // What is named already comes first: where it leaves much, the rest is described rather than searched for.
  Policy policy = policy_;
  policy.dear = diagnosis.accepted.empty();
  const bool is_far = !is_below(policy_.hopeless, diagnosis.final_stage.estimate, data_);
  Tried tried =
      screen_candidates(diagnosis.final_stage, catalogue_, names_of(diagnosis.accepted), data_, progress_);
  // Far above the floor the commonest truth comes first: it may save the refits of all single effects.
  std::optional<Group> group;
  if (diagnosis.accepted.empty() && is_far) {
    group = standard_effects(tried, data_, policy_, progress_);
  }
  if (!group) {
    refit_candidates(data_, policy, progress_, tried);
  }
  const Choice choice = choose(tried.stage, tried.refits, data_, policy);
  const std::vector<RankRow> rows = ranking_of(tried, choice, data_, policy);
  diagnosis.candidates = std::max(diagnosis.candidates, static_cast<int>(tried.hypotheses.size()));
  if (!group && diagnosis.accepted.empty()) {
    group = standard_effects(tried, data_, policy_, progress_);
  }
  if (group) {
    accept_group(tried, *group, data_, diagnosis);
  } else if (choice.named >= 0) {
    accept(tried, choice, data_, diagnosis);
  }
  const bool is_named = group || choice.named >= 0;
  if (is_named) {
    progress_(fmt::format("so far {}: {:.2f} to {:.2f} floors", diagnosis.ladder.back().name,
                          judged(diagnosis.ladder.front().stage.estimate, data_),
                          judged(diagnosis.final_stage.estimate, data_)),
              1.0);
  }
  diagnosis.unnamed = is_named ? std::nullopt : unnamed_of(tried, data_, policy_);
  diagnosis.leads.clear();
  for (const RankRow& row : rows) {
    if (row.refitted && !row.remark.empty()) {
      diagnosis.leads.push_back(row);
    }
  }
  diagnosis.at_one_place =
      is_named ? std::nullopt : at_one_place(diagnosis.leads, diagnosis.final_stage.model, policy_);
  if (diagnosis.ranking.empty()) {
    diagnosis.ranking = rows;
  }
  if (round == 0) {
    first_ = std::move(tried);
  }
  return is_named;
}

}  // namespace plumbline::validation
