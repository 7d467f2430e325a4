#include "validation/diagnose/diagnose.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "simulator/trace/error.h"
#include "validation/diagnose/accept.h"
#include "validation/diagnose/choose.h"
#include "validation/diagnose/findings.h"
#include "validation/diagnose/finish.h"
#include "validation/diagnose/own_by_parts.h"
#include "validation/diagnose/own_parameters.h"
#include "validation/diagnose/pair_step.h"
#include "validation/diagnose/revise.h"
#include "validation/diagnose/same_force.h"
#include "validation/predict/kept_results.h"
#include "validation/predict/reach.h"

namespace plumbline::validation {
namespace {

class Diagnoser {
 public:
  /// `followed` are the beginnings of the windows, `part` of their lengths.
  Diagnoser(const effects::Catalogue& catalogue, const Followed& followed, double part,
            const DiagnoseOptions& options, const Progress& progress)
      : catalogue_(catalogue),
        data_(followed.data),
        x0_(followed.x0),
        part_(part),
        options_(options),
        progress_(progress) {}

  /// With the model's own numbers exactly as stated, and with them free within what is stated of them: the
  /// first where that gives an answer and the data do not speak for other numbers.
  void run(const model::Model& model, Diagnosis& diagnosis) {
    start(model, diagnosis);
    const Rung given = diagnosis.ladder.front();
    const Stage open = is_below(options_.at_floor, given.stage.estimate, data_)
                           ? given.stage
                           : with_open_numbers(given.stage, 0, options_.parameter_width, data_);
    if (open.parameters.empty()) {
      look(options_.most_effects, diagnosis);
      return;
    }
    Rung fitted{"own parameters fitted", fit_own(open), part_};
    if (part_ == 1.0) {
      look_with_own_numbers(given, fitted, diagnosis);
      return;
    }
    if (!explains_nearly_all(given, fitted)) {
      fitted.stage = fit_own_by_parts(given.stage, part_, options_.parameter_width, data_);
    }
    look_at_beginnings(given, fitted, diagnosis);
  }

  /// What was named on shorter beginnings, on these; and what else is missing here.
  void go_on(Diagnosis& diagnosis) {
    progress_(fmt::format("longer parts of the windows: {:.0f} %", 100.0 * part_), 0.0);
    const Stage& before = diagnosis.final_stage;
    take("the same further on", fitted_anew({fitted_model(before), before.parameters, {}}, data_, x0_),
         diagnosis);
    open_own_numbers(diagnosis);
    if (!is_below(enough(), diagnosis.final_stage.estimate, data_)) {
      replace_last(with_fresh_states(diagnosis.final_stage), diagnosis);
    }
    look(options_.most_effects - static_cast<int>(diagnosis.accepted.size()), diagnosis);
  }

  /// The first round from the model that nothing was added to; empty where none was needed.
  const Tried& first() const { return first_; }

 private:
  void start(const model::Model& model, Diagnosis& diagnosis) {
    progress_("the model as given", 0.0);
    Stage& stage = diagnosis.final_stage;
    stage.model = model;
    PredictorPool pool(model, data_);
    const Estimate given = estimate_states(pool, x0_);
    diagnosis.ladder.push_back({"as given", {model, {}, given}, part_});
    stage.estimate = given;
  }

  /// Fitted once more from initial states that were searched anew with the values as they are now: those that
  /// went along with the values may have stayed behind in a minimum of their own. The better of the two.
  Stage with_fresh_states(const Stage& fitted) const {
    Stage fresh{fitted_model(fitted), fitted.parameters, {}};
    PredictorPool pool(fresh.model, data_);
    const Estimate states = estimate_states(pool);
    fresh.estimate = gauss_newton(pool, fresh.parameters, fitted.estimate.theta, states.x0, {10, 1e-4});
    return judged(fresh.estimate, data_) < judged(fitted.estimate, data_) ? fresh : fitted;
  }

  /// The error at which there is nothing to look for. On beginnings of the windows one that would be an
  /// answer: what little is left shows better further on.
  double enough() const { return part_ < 1.0 ? options_.finished : options_.at_floor; }

  /// One effect after the other from where the ladder stands.
  void look(int most, Diagnosis& diagnosis) {
    for (int round = 0; round < most; ++round) {
      if (is_below(enough(), diagnosis.final_stage.estimate, data_) || !step(diagnosis, round)) {
        break;
      }
    }
    revise_rivals(catalogue_, data_, options_, progress_, diagnosis);
    conclude(data_, options_, diagnosis);
  }

  /// As a whole: an interruption must not leave parameters without their values.
  static void restart(const std::vector<Rung>& ladder, Diagnosis& diagnosis) {
    Diagnosis anew;
    anew.ladder = ladder;
    anew.bare_rungs = ladder.size();
    anew.final_stage = ladder.back().stage;
    diagnosis = std::move(anew);
  }

  /// Beginnings are too short to tell masses and inertias, which free would stand in for a part of anything:
  /// with the numbers as stated, unless others explain nearly all or nothing explains the rest.
  void look_at_beginnings(const Rung& given, const Rung& fitted, Diagnosis& diagnosis) {
    if (explains_nearly_all(given, fitted)) {
      restart({given, fitted}, diagnosis);
      look(options_.most_effects, diagnosis);
      return;
    }
    look(options_.most_effects, diagnosis);
    if (diagnosis.verdict != Verdict::unexplained) {
      return;
    }
    Tried first = std::move(first_);
    Diagnosis other;
    restart({given, fitted}, other);
    look(options_.most_effects, other);
    if (judged(other.final_stage.estimate, data_) <
        (1.0 - options_.material) * judged(diagnosis.final_stage.estimate, data_)) {
      diagnosis = std::move(other);
    } else {
      first_ = std::move(first);
    }
  }

  /// With the numbers as stated first, because an answer with them says more. But where other numbers alone
  /// explain nearly everything, first with the numbers free. The stated ones then need no trial if an effect
  /// is named beside which the data speak against them, or if no answer was found: it would have been one
  /// with free numbers, too.
  void look_with_own_numbers(const Rung& given, const Rung& fitted, Diagnosis& diagnosis) {
    if (!explains_nearly_all(given, fitted)) {
      look(options_.most_as_stated, diagnosis);
      if (!speaks_for_stated(diagnosis)) {
        restart({given, fitted}, diagnosis);
        look(options_.most_effects, diagnosis);
      }
      return;
    }
    restart({given, fitted}, diagnosis);
    look(options_.most_effects, diagnosis);
    if (diagnosis.verdict == Verdict::unexplained ||
        (diagnosis.verdict == Verdict::missing && evidence(diagnosis) < -std::log(options_.evidence))) {
      return;
    }
    Tried first = std::move(first_);
    Diagnosis stated;
    restart({given}, stated);
    look(options_.most_as_stated, stated);
    if (speaks_for_stated(stated)) {
      diagnosis = std::move(stated);
    } else {
      first_ = std::move(first);
    }
  }

  /// What is left above the floor with the numbers fitted is a small share of what was.
  bool explains_nearly_all(const Rung& given, const Rung& fitted) const {
    constexpr double kLeft = 0.05;
    const double before = judged(given.stage.estimate, data_);
    const double after = judged(fitted.stage.estimate, data_);
    return before > options_.finished && after * after - 1.0 < kLeft * (before * before - 1.0);
  }

  double evidence(const Diagnosis& diagnosis) const {
    return evidence_for_stated(diagnosis.final_stage, data_, options_.parameter_width);
  }

  /// An answer at the floor that would be improbable if the model's own numbers were not exactly as stated.
  bool speaks_for_stated(const Diagnosis& diagnosis) const {
    return diagnosis.verdict == Verdict::nothing_missing ||
           (diagnosis.verdict == Verdict::missing && evidence(diagnosis) > std::log(options_.evidence));
  }

  /// Beside what is named, and more of them than on shorter parts: where that alone is not at the floor and
  /// they help.
  void open_own_numbers(Diagnosis& diagnosis) const {
    const Stage& stage = diagnosis.final_stage;
    if (is_below(enough(), stage.estimate, data_)) {
      return;
    }
    const Stage open = with_open_numbers(stage, diagnosis.accepted.size(), options_.parameter_width, data_);
    if (open.parameters.size() == stage.parameters.size()) {
      return;
    }
    const Stage fitted = fit_own(open);
    if (judged(fitted.estimate, data_) < (1.0 - options_.material) * judged(stage.estimate, data_)) {
      take("own parameters fitted", fitted, diagnosis);
    }
  }

  /// A rung, and the values that it gives to what is named.
  void take(const std::string& name, const Stage& stage, Diagnosis& diagnosis) const {
    diagnosis.ladder.push_back({name, stage, part_});
    replace_last(stage, diagnosis);
  }

  void replace_last(const Stage& stage, Diagnosis& diagnosis) const {
    set_values(stage, data_, diagnosis.accepted);
    diagnosis.final_stage = stage;
    diagnosis.ladder.back().stage = stage;
  }

  Stage fit_own(const Stage& open) const {
    progress_("the model's own parameters", 0.0);
    return fit_open_numbers(open, data_);
  }

  /// A law that is already named at a place is not named there again: two of a kind can add up to a third.
  static std::vector<std::string> names_of(const std::vector<Finding>& findings) {
    std::vector<std::string> names;
    names.reserve(findings.size());
    for (const Finding& finding : findings) {
      names.push_back(finding.label());
    }
    return names;
  }

  bool step(Diagnosis& diagnosis, int round) {
    Tried tried = try_candidates(diagnosis.final_stage, catalogue_, names_of(diagnosis.accepted), data_,
                                 options_, progress_);
    const Choice choice = choose(tried.stage, tried.refits, data_, options_);
    const std::vector<RankRow> rows = ranking_of(tried, choice, data_, options_);
    diagnosis.candidates = std::max(diagnosis.candidates, static_cast<int>(tried.hypotheses.size()));
    if (choice.named >= 0) {
      accept(tried, choice, data_, diagnosis);
    }
    diagnosis.leads.clear();
    for (const RankRow& row : rows) {
      if (row.refitted && !row.remark.empty()) {
        diagnosis.leads.push_back(row);
      }
    }
    if (diagnosis.ranking.empty()) {
      diagnosis.ranking = rows;
    }
    if (round == 0) {
      first_ = std::move(tried);
    }
    return choice.named >= 0;
  }

  const effects::Catalogue& catalogue_;
  const Data& data_;
  const std::vector<Eigen::VectorXd>& x0_;  // where the windows begin; empty: to be searched
  double part_;
  const DiagnoseOptions& options_;
  const Progress& progress_;
  Tried first_;
};

/// On what part of the windows to go on after `part`: as far as the stage can be followed; where it is at the
/// floor at least one step.
double further(const Stage& stage, const Data& beginnings, const Data& data, double part,
               const DiagnoseOptions& options) {
  const double least = is_below(options.finished, stage.estimate, beginnings) ? longer_part(part) : part;
  return std::max(least, reach_further(fitted_model(stage), data, part, stage.estimate.x0));
}

/// On the beginnings of the windows over which the model can be followed, and from there on to the whole.
/// What does not lead to the floor may still lead further, where more can be told. Returns the windows on
/// which it ended.
Data diagnose_by_parts(const model::Model& model, const effects::Catalogue& catalogue, const Data& data,
                       const DiagnoseOptions& options, const Progress& progress, Diagnosis& diagnosis) {
  const auto say_how_far = [&] { progress("how far the model can be followed", 0.0); };
  say_how_far();
  double part = reach(model, data);
  for (bool first = true;; first = false) {
    const Followed followed =
        follow(first ? model : fitted_model(diagnosis.final_stage), data.beginnings(part));
    Diagnoser diagnoser(catalogue, followed, part, options, progress);
    first ? diagnoser.run(model, diagnosis) : diagnoser.go_on(diagnosis);
    double longer = part;
    if (part < 1.0) {
      say_how_far();
      longer = further(diagnosis.final_stage, followed.data, data, part, options);
    }
    if (longer <= part) {
      if (first && diagnosis.verdict == Verdict::unexplained) {
        look_for_pair(diagnoser.first(), catalogue, followed.data, options, progress, diagnosis);
      }
      return followed.data;
    }
    if (first) {
      drop_superfluous(followed.data, options, progress, diagnosis);
    }
    part = longer;
  }
}

/// What is said of all windows, where candidates were tried on some.
void finish(const Data& data, const Data& tried, const DiagnoseOptions& options, const Progress& progress,
            Diagnosis& diagnosis) {
  const double part = diagnosis.ladder.back().part;
  const bool is_some = tried.windows.size() < data.windows.size();
  const Data beginnings = data.beginnings(part);
  const Data all = is_some ? follow(fitted_model(diagnosis.final_stage), beginnings).data : tried;
  diagnosis.windows = all.windows.size();
  for (std::size_t w = 0; w < all.windows.size(); ++w) {
    diagnosis.cut_windows += all.windows[w].count < beginnings.windows[w].count ? 1 : 0;
  }
  if (is_some) {
    rescore(all, progress, diagnosis);
  }
  if (diagnosis.ladder.front().part >= part) {  // else they have been tried without on shorter parts
    drop_superfluous(all, options, progress, diagnosis);
  }
  if (!diagnosis.accepted.empty() && is_below(options.finished, diagnosis.final_stage.estimate, all)) {
    settle_values(all, progress, diagnosis);
  }
  take_open_values(all, diagnosis);
  set_values(diagnosis.final_stage, all, diagnosis.accepted);
  conclude(all, options, diagnosis);
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
                   const DiagnoseOptions& options, const Progress& progress) {
  if (!data.has(Role::train)) {
    throw InputError("found no trial with role: train, expected at least one");
  }
  Diagnosis diagnosis;
  Data some = data.thinned(options.windows);
  if (!some.kept) {
    some.kept = std::make_shared<KeptResults>();  // some work is asked for in more than one place
  }
  try {
    const Data tried = diagnose_by_parts(model, catalogue, some, options, progress, diagnosis);
    finish(data, tried, options, progress, diagnosis);
    mark_same_forces(fitted_model(diagnosis.final_stage), catalogue, diagnosis.accepted);
  } catch (const Stopped&) {
    diagnosis.interrupted = true;
    if (!diagnosis.ladder.empty()) {
      conclude(data, options, diagnosis);
    }
  }
  return diagnosis;
}

}  // namespace plumbline::validation
