#include "validation/diagnose/diagnose.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "simulator/trace/error.h"
#include "validation/diagnose/confirm.h"
#include "validation/diagnose/own_parameters.h"
#include "validation/predict/deviations.h"

namespace plumbline::validation {
namespace {

/// The error that counts: held-out where there is one.
double judged(const Scores& scores, const Data& data) {
  return data.has(Role::held_out) ? scores.held_out : scores.train;
}

bool at_floor(const Scores& scores, const Data& data, const DiagnoseOptions& options) {
  return judged(scores, data) < options.at_floor && scores.train < options.at_floor;
}

/// Candidates in order of promise, refitted ones first with what they reached.
std::vector<RankRow> rank(const std::vector<Candidate>& candidates, const std::vector<Hypothesis>& hypotheses,
                          const std::vector<Refit>& refits) {
  std::vector<RankRow> rows;
  std::vector<bool> done(candidates.size(), false);
  for (const Refit& refit : refits) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(refit.candidate)];
    done[static_cast<std::size_t>(refit.candidate)] = true;
    rows.push_back({candidate.law->declaration().name, candidate.at, refit.square(),
                    refit.estimate.scores.held_out, refit.estimate.scores.train, true, ""});
  }
  for (const Hypothesis& hypothesis : hypotheses) {
    const auto c = static_cast<std::size_t>(hypothesis.candidate);
    if (!done[c]) {
      done[c] = true;
      rows.push_back({candidates[c].law->declaration().name, candidates[c].at, hypothesis.promised(),
                      std::sqrt(hypothesis.promised_held_out), std::sqrt(hypothesis.promised_train), false,
                      ""});
    }
  }
  return rows;
}

/// Error of a refit that counts for choosing: train and held-out together.
double together(const Refit& refit) { return std::sqrt(refit.square()); }

/// How much a law takes for granted: its fitted parameters, then its choices and numerical constants.
std::pair<int, int> complexity(const std::vector<Candidate>& candidates, const Refit& refit) {
  return {refit.own, candidates[static_cast<std::size_t>(refit.candidate)].law->parameter_count()};
}

/// Refits that predict as well as the best, or nearly: a simpler law is named before them.
std::vector<std::size_t> near_best(const std::vector<Refit>& refits, const DiagnoseOptions& options) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < refits.size(); ++i) {
    if (together(refits[i]) < (1.0 + options.simpler) * together(refits.front())) {
      near.push_back(i);
    }
  }
  return near;
}

/// Relative difference of squared errors that the searches themselves may leave.
constexpr double kSame = 2e-3;

/// What these data cannot tell from the named law: of no more parameters those that win in a fair share of
/// resamples or leave the same error; of more parameters those that are surely better, if only by little.
std::vector<std::size_t> rivals_of(std::size_t named, const std::vector<Refit>& refits, const Data& data,
                                   const DiagnoseOptions& options) {
  constexpr double kFair = 0.05;
  std::vector<std::size_t> rivals;
  for (std::size_t i = 0; i < refits.size(); ++i) {
    if (i == named) {
      continue;
    }
    const double wins = share_better(refits[i], refits[named], data, options);
    const double ratio = refits[i].square() / refits[named].square();
    const bool smaller = refits[i].own <= refits[named].own;
    if (smaller ? wins > kFair || ratio < 1.0 + kSame : wins > 1.0 - kFair && ratio < 1.0 - kSame) {
      rivals.push_back(i);
    }
  }
  return rivals;
}

/// The data with a limit to the integrator steps in a window: a candidate that needs many more than the stage
/// would be stiffer than anything that the samples could show, and cost as much as all others together.
Data without_stiffness(const Stage& stage, const Data& data) {
  constexpr double kLeast = 40.0;
  constexpr double kTimesTheStage = 5.0;
  constexpr double kEvaluationsOfStep = 3.0;
  PredictorPool pool(stage.model, data);
  double most = 0.0;
  for (std::size_t w = 0; w < data.windows.size(); w += std::max<std::size_t>(1, data.windows.size() / 4)) {
    const long before = pool.evaluations();
    pool.with(static_cast<int>(w), stage.parameters, stage.estimate.theta,
              [&](Predictor& predictor) { predictor.residual(data.windows[w], stage.estimate.x0[w]); });
    most = std::max(most, static_cast<double>(pool.evaluations() - before) /
                              (kEvaluationsOfStep * static_cast<double>(data.windows[w].count)));
  }
  Data limited = data;
  limited.predict.most_steps = std::max(kLeast, kTimesTheStage * most);
  return limited;
}

class Diagnoser {
 public:
  Diagnoser(const effects::Catalogue& catalogue, const Data& data, const DiagnoseOptions& options,
            const Progress& progress)
      : catalogue_(catalogue), data_(data), options_(options), progress_(progress) {}

  /// First with the model's own numbers exactly as stated. If that gives no answer, or the data speak for
  /// other numbers, anew with the numbers free within what is stated of them.
  void run(const model::Model& model, Diagnosis& diagnosis) {
    start(model, diagnosis);
    const Stage open = with_open_numbers(diagnosis.final_stage);
    take_steps(open.parameters.empty() ? options_.most_effects : options_.most_as_stated, diagnosis);
    conclude(diagnosis);
    if (!open.parameters.empty() && !speaks_for_stated(diagnosis)) {
      fit_own(open, diagnosis);
      take_steps(options_.most_effects, diagnosis);
    }
  }

  /// The ladder on all windows, where candidates were tried on a part of them.
  void rescore(const Data& all, Diagnosis& diagnosis) const {
    for (Rung& rung : diagnosis.ladder) {
      progress_("all windows for " + rung.name, 0.9);
      PredictorPool pool(rung.stage.model, all);
      rung.stage.estimate =
          gauss_newton(pool, rung.stage.parameters, rung.stage.estimate.theta, {}, {8, 1e-3});
    }
    diagnosis.final_stage = diagnosis.ladder.back().stage;
    for (Finding& finding : diagnosis.accepted) {
      for (std::size_t r = 1; r < diagnosis.ladder.size(); ++r) {
        if (diagnosis.ladder[r].name == "+ " + finding.effect + "@" + finding.at) {
          finding.train_before = diagnosis.ladder[r - 1].train();
          finding.held_out_before = diagnosis.ladder[r - 1].held_out();
          finding.train_after = diagnosis.ladder[r].train();
          finding.held_out_after = diagnosis.ladder[r].held_out();
        }
      }
    }
  }

  /// An early guess that the later ones make superfluous is dropped again.
  void drop_superfluous(const Data& all, Diagnosis& diagnosis) const {
    for (std::size_t i = 0; diagnosis.accepted.size() > 1 && i + 1 < diagnosis.accepted.size();) {
      Stage& stage = diagnosis.final_stage;
      const auto effect = static_cast<int>(stage.model.effects.size() - diagnosis.accepted.size() + i);
      progress_("is " + diagnosis.accepted[i].effect + "@" + diagnosis.accepted[i].at + " still needed", 0.9);
      Stage without = without_effect(stage, effect);
      PredictorPool pool(without.model, all);
      without.estimate = gauss_newton(pool, without.parameters, values_of(without.model, without.parameters),
                                      {}, {10, 1e-3});
      const double rise = judged(without.estimate.scores, all) / judged(stage.estimate.scores, all) - 1.0;
      if (rise < options_.material) {
        diagnosis.ladder.push_back(
            {"- " + diagnosis.accepted[i].effect + "@" + diagnosis.accepted[i].at, without});
        diagnosis.accepted.erase(diagnosis.accepted.begin() + static_cast<std::ptrdiff_t>(i));
        stage = without;
      } else {
        ++i;
      }
    }
  }

  void conclude(Diagnosis& diagnosis) const {
    const double before = judged(first_rung(diagnosis).stage.estimate.scores, data_);
    const double after = judged(diagnosis.final_stage.estimate.scores, data_);
    const double excess = before * before - 1.0;
    diagnosis.unexplained_share = excess > 0.0 ? std::clamp((after * after - 1.0) / excess, 0.0, 1.0) : 0.0;
    if (diagnosis.accepted.empty()) {
      diagnosis.verdict = before < 1.1 ? Verdict::nothing_missing : Verdict::unexplained;
    } else {
      // Names that leave the error far above the floor are a part of the answer at best.
      diagnosis.verdict = after < options_.finished ? Verdict::missing : Verdict::unexplained;
    }
    if (diagnosis.verdict == Verdict::nothing_missing) {
      diagnosis.unexplained_share = 0.0;
    }
  }

 private:
  /// The rung before anything was added.
  static const Rung& first_rung(const Diagnosis& diagnosis) {
    const bool fitted = diagnosis.ladder.size() > 1 && diagnosis.ladder[1].name == "own parameters fitted";
    return diagnosis.ladder[fitted ? 1 : 0];
  }

  void start(const model::Model& model, Diagnosis& diagnosis) {
    progress_("the model as given", 0.0);
    Stage& stage = diagnosis.final_stage;
    stage.model = model;
    PredictorPool pool(model, data_);
    const Estimate given = gauss_newton(pool, {}, Eigen::VectorXd(), {}, {8, 1e-4});
    diagnosis.ladder.push_back({"as given", {model, {}, given}});
    stage.estimate = given;
  }

  void take_steps(int most, Diagnosis& diagnosis) {
    for (int round = 0; round < most; ++round) {
      if (at_floor(diagnosis.final_stage.estimate.scores, data_, options_) || !step(diagnosis, round)) {
        break;
      }
    }
  }

  /// The stage with the numbers that its model states with an uncertainty as free parameters, not yet fitted.
  Stage with_open_numbers(const Stage& given) const {
    Stage open{with_stated_errors(given.model), {}, given.estimate};
    PredictorPool pool(open.model, data_);
    open.parameters = noticeable_parameters(pool, stated_parameters(open.model, options_.parameter_width),
                                            given.estimate.x0);
    return open;
  }

  /// An answer at the floor that would be improbable if the model's own numbers were not exactly as stated.
  bool speaks_for_stated(const Diagnosis& diagnosis) const {
    const Stage& stage = diagnosis.final_stage;
    return diagnosis.verdict == Verdict::nothing_missing ||
           (diagnosis.verdict == Verdict::missing &&
            evidence_for_stated(stage, data_, options_.parameter_width) > std::log(options_.evidence));
  }

  /// Starts anew from the model as given, with its own numbers free.
  void fit_own(const Stage& open, Diagnosis& diagnosis) const {
    const Rung given = diagnosis.ladder.front();
    progress_("the model's own parameters", 0.5);
    PredictorPool pool(open.model, data_);
    const Stage fitted{open.model, open.parameters,
                       gauss_newton(pool, open.parameters, values_of(open.model, open.parameters),
                                    open.estimate.x0, {10, 1e-4})};
    // As a whole: an interruption must not leave parameters without their values.
    diagnosis = Diagnosis();
    diagnosis.ladder = {given, {"own parameters fitted", fitted}};
    diagnosis.final_stage = fitted;
  }

  /// A law that is already named at a place is not named there again: two of a kind can add up to a third.
  static void leave_out_accepted(const Diagnosis& diagnosis, std::vector<Candidate>& candidates) {
    const auto is_named = [&](const Candidate& candidate) {
      return std::any_of(diagnosis.accepted.begin(), diagnosis.accepted.end(), [&](const Finding& finding) {
        return finding.effect == candidate.law->declaration().name && finding.at == candidate.at;
      });
    };
    candidates.erase(std::remove_if(candidates.begin(), candidates.end(), is_named), candidates.end());
  }

  bool step(Diagnosis& diagnosis, int round) {
    Stage& stage = diagnosis.final_stage;
    std::vector<Candidate> candidates;
    {
      PredictorPool pool(stage.model, data_);
      candidates = list_candidates(pool, catalogue_, stage.parameters, stage.estimate);
    }
    leave_out_accepted(diagnosis, candidates);
    const Data quick = without_stiffness(stage, data_);
    const std::vector<Hypothesis> hypotheses = screen(stage, candidates, quick, progress_);
    const std::vector<Refit> refits = refit(stage, candidates, hypotheses, quick, options_, progress_);
    diagnosis.candidates = std::max(diagnosis.candidates, static_cast<int>(hypotheses.size()));
    std::vector<RankRow> rows = rank(candidates, hypotheses, refits);
    const bool accepted = !refits.empty() && judge(candidates, refits, rows, diagnosis);
    if (round == 0) {
      diagnosis.ranking = rows;
    }
    diagnosis.leads.clear();
    for (const RankRow& row : rows) {
      if (row.refitted && !row.remark.empty()) {
        diagnosis.leads.push_back(row);
      }
    }
    return accepted;
  }

  /// Of the refits that are about as good as the best, the one with the fewest parameters is named (a law
  /// that contains another is not preferred to it for an immaterial gain), if nothing speaks against it.
  bool judge(const std::vector<Candidate>& candidates, const std::vector<Refit>& refits,
             std::vector<RankRow>& rows, Diagnosis& diagnosis) const {
    const Stage& stage = diagnosis.final_stage;
    const std::vector<double> shares = selected_shares(stage, refits, data_, options_);
    std::vector<std::size_t> near = near_best(refits, options_);
    double share = 0.0;
    for (const std::size_t i : near) {
      share += shares[i];
    }
    for (std::size_t i = 0; i < refits.size(); ++i) {
      const bool is_near = std::find(near.begin(), near.end(), i) != near.end();
      rows[i].remark = objection(stage, candidates[static_cast<std::size_t>(refits[i].candidate)], refits[i],
                                 is_near ? share : shares[i], data_, options_);
      const Role judged_role = data_.has(Role::held_out) ? Role::held_out : Role::train;
      rows[i].selected_share = shares[i];
      std::tie(rows[i].judged_low, rows[i].judged_high) =
          resampled_error(refits[i], judged_role, data_, options_);
    }
    std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
      return complexity(candidates, refits[a]) < complexity(candidates, refits[b]);
    });
    const auto named =
        std::find_if(near.begin(), near.end(), [&](std::size_t i) { return rows[i].remark.empty(); });
    if (named == near.end()) {
      return false;
    }
    accept(candidates, refits, rivals_of(*named, refits, data_, options_), *named, share, diagnosis);
    return true;
  }

  void accept(const std::vector<Candidate>& candidates, const std::vector<Refit>& refits,
              const std::vector<std::size_t>& rivals, std::size_t named, double share,
              Diagnosis& diagnosis) const {
    const Refit& refit = refits[named];
    const Candidate& candidate = candidates[static_cast<std::size_t>(refit.candidate)];
    Finding finding;
    finding.effect = candidate.law->declaration().name;
    finding.at = candidate.at;
    finding.equation = candidate.law->declaration().equation;
    finding.selected_share = share;
    const Scores before = diagnosis.final_stage.estimate.scores;
    finding.train_before = before.train;
    finding.held_out_before = before.held_out;
    finding.train_after = refit.estimate.scores.train;
    finding.held_out_after = refit.estimate.scores.held_out;
    for (const std::string& same : candidate.same_places) {
      finding.rivals.push_back({finding.effect, same});
    }
    for (const std::size_t i : rivals) {
      const Candidate& rival = candidates[static_cast<std::size_t>(refits[i].candidate)];
      finding.rivals.push_back({rival.law->declaration().name, rival.at});
    }
    const Stage next{with_values(refit.extended.model, refit.extended.parameters, refit.estimate.theta),
                     refit.extended.parameters, refit.estimate};
    PredictorPool pool(next.model, data_);
    const Eigen::VectorXd deviations = parameter_deviations(
        pool, data_.windows_of(Role::train), refit.extended.parameters, refit.estimate, nullptr);
    for (std::size_t p = refit.extended.parameters.size() - static_cast<std::size_t>(refit.own);
         p < refit.extended.parameters.size(); ++p) {
      const auto i = static_cast<Eigen::Index>(p);
      const std::string& label = refit.extended.parameters[p].label;
      finding.parameters.push_back({label.substr(label.find(':') + 1), refit.extended.parameters[p].unit,
                                    refit.estimate.theta[i], deviations[i]});
    }
    diagnosis.final_stage = next;  // together with the finding: an interruption comes before both or after
    diagnosis.accepted.push_back(finding);
    diagnosis.ladder.push_back({"+ " + candidate.label(), diagnosis.final_stage});
  }

  static Stage without_effect(const Stage& stage, int effect) {
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

  const effects::Catalogue& catalogue_;
  const Data& data_;
  const DiagnoseOptions& options_;
  const Progress& progress_;
};

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
  const Data part = data.thinned(options.windows);
  Diagnoser diagnoser(catalogue, part, options, progress);
  try {
    diagnoser.run(model, diagnosis);
    if (part.windows.size() < data.windows.size()) {
      diagnoser.rescore(data, diagnosis);
    }
    diagnoser.drop_superfluous(data, diagnosis);
    diagnoser.conclude(diagnosis);
  } catch (const Stopped&) {
    diagnosis.interrupted = true;
    if (!diagnosis.ladder.empty()) {
      diagnoser.conclude(diagnosis);
    }
  }
  return diagnosis;
}

}  // namespace plumbline::validation
