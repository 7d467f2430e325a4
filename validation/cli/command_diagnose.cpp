#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "simulator/trace/error.h"
#include "validation/api/diagnosing.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"
#include "validation/identify/diagnose/own_parameters.h"
#include "validation/identify/predict/kept_results.h"
#include "validation/report/sentences.h"

namespace plumbline::cli {
namespace {

using validation::Diagnosis;
using validation::Finding;
using validation::OwnParameter;
using validation::PairRow;
using validation::ParameterValue;
using validation::RankRow;
using validation::Rival;
using validation::Verdict;

using validation::UnexplainedForce;

/// The force that the final model does not explain, where the inverse model or a force plate can tell.
void print_unexplained(const std::vector<UnexplainedForce>& forces) {
  constexpr double kShown = 0.02;
  if (forces.empty()) {
    return;
  }
  fmt::print(
      "\nUnexplained force (at motors recorded minus needed, low-passed; of plates measured minus predicted,"
      "\non the ground):\n\n");
  std::vector<std::vector<std::string>> rows;
  for (const UnexplainedForce& f : forces) {
    std::string shares;
    for (const validation::Dependence& d : f.dependences) {
      if (d.share >= kShown) {
        shares += fmt::format("{}{} {:.0f} %  ", d.variable, d.of_size ? " (size)" : "", 100.0 * d.share);
      }
    }
    rows.push_back({f.trial, f.at, f.below > 0.0 ? fmt::format("{:.3g} Hz", f.below) : "-",
                    fmt::format("{:.3g} {}", f.rms, f.unit),
                    f.sensors > 0.0 ? fmt::format("{:.2g} {}", f.sensors, f.unit) : "-",
                    fmt::format("{:.1f} %", 100.0 * f.relative), f.words, shares});
  }
  print_table({"trial", "at", "below", "rms", "sensors alone", "of the force", "it",
               "share of its variance that follows"},
              rows);
}

/// Those that are the same force, or those that are not.
void print_rivals(const char* what, const Finding& finding, bool same) {
  std::string names;
  for (const Rival& rival : finding.rivals) {
    if (rival.same == same) {
      names += fmt::format("{} {} at {}", names.empty() ? "" : ";", rival.name.effect, rival.name.at);
      names += same ? "" : fmt::format(" (correlation {:.4f})", rival.correlation);
    }
  }
  if (!names.empty()) {
    fmt::print("  {}:{}.\n", what, names);
  }
}

/// `best`: of a model that was found without a name.
void print_verdict(const Diagnosis& diagnosis, const std::string& best) {
  if (diagnosis.interrupted) {
    fmt::print("Stopped before the end: what follows is what was finished.\n\n");
  }
  if (diagnosis.ladder.empty()) {
    fmt::print("Nothing was finished.\n");
    return;
  }
  const validation::Rung& last = diagnosis.ladder.back();
  if (diagnosis.interrupted && diagnosis.accepted.empty()) {
    fmt::print("No effect had been accepted yet; the held-out error so far is {:.2f} times the floor.\n",
               last.foretold());
    return;
  }
  const std::string verdict = best.empty() ? validation::verdict_sentence(diagnosis) : best;
  if (!verdict.empty()) {
    fmt::print("{}\n", verdict);
  }
  for (const Finding& finding : diagnosis.accepted) {
    fmt::print("{}\n", validation::finding_sentences(finding, diagnosis));
    fmt::print("  {}\n", finding.equation);
    for (const ParameterValue& p : finding.parameters) {
      const std::string how = p.chosen ? "(chosen)" : fmt::format("+- {:.2g} {}", p.deviation, p.unit);
      fmt::print("  {} = {:.4g} {}\n", p.name, p.value, how);
    }
    print_rivals("On this model it is the same force as", finding, true);
    print_rivals("These data cannot tell it from", finding, false);
  }
  for (const std::string& remark : validation::remarks(diagnosis)) {
    fmt::print("{}\n", remark);
  }
}

void print_rows(const std::vector<RankRow>& ranking, std::size_t most) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < std::min(most, ranking.size()); ++i) {
    const RankRow& r = ranking[i];
    rows.push_back({r.effect, r.at, fmt::format("{:.3f}", r.train_after),
                    fmt::format("{:.3f}", r.held_out_after), r.refitted ? "refitted" : "promised", r.remark});
  }
  print_table({"effect", "at", "train", "held-out", "", "remark"}, rows);
}

/// Pairs that were tried together, the accepted one among them.
void print_pairs(const std::vector<PairRow>& pairs) {
  if (pairs.empty()) {
    return;
  }
  fmt::print("\nTried two at once:\n\n");
  std::vector<std::vector<std::string>> rows;
  rows.reserve(pairs.size());
  for (const PairRow& r : pairs) {
    rows.push_back({r.first.label(), r.second.label(), fmt::format("{:.3f}", r.train_after),
                    fmt::format("{:.3f}", r.held_out_after), r.remark});
  }
  print_table({"one", "other", "train", "held-out", "remark"}, rows);
}

/// What the fit made of the numbers that the model states with an uncertainty.
void print_own_parameters(const std::vector<OwnParameter>& parameters) {
  if (parameters.empty()) {
    return;
  }
  fmt::print("\nModel parameters, within what is stated of them:\n\n");
  std::vector<std::vector<std::string>> rows;
  rows.reserve(parameters.size());
  for (const OwnParameter& p : parameters) {
    rows.push_back({p.label, fmt::format("{:.4g} +- {:.2g} {}", p.stated, p.stated_deviation, p.unit),
                    fmt::format("{:.4g}", p.value), fmt::format("{:+.1f}", p.shift())});
  }
  print_table({"parameter", "stated", "fitted", "shift in deviations"}, rows);
}

/// On how long windows the errors are is said where these are not the whole ones.
void print_ladder(const std::vector<validation::Rung>& ladder) {
  fmt::print("\nLadder (error in units of the floor):\n\n");
  const bool in_segments = std::any_of(ladder.begin(), ladder.end(),
                                       [](const validation::Rung& rung) { return !std::isinf(rung.length); });
  std::vector<std::string> head{"model", "train", "held-out", "predictive"};
  if (in_segments) {
    head.insert(head.begin() + 1, "windows");
  }
  std::vector<std::vector<std::string>> rows;
  for (const validation::Rung& rung : ladder) {
    rows.push_back({rung.name, fmt::format("{:.3f}", rung.train()), fmt::format("{:.3f}", rung.held_out()),
                    fmt::format("{:.3f}", rung.foretold())});
    if (in_segments) {
      rows.back().insert(rows.back().begin() + 1,
                         std::isinf(rung.length) ? "whole" : fmt::format("{:.2g} s", rung.length));
    }
  }
  print_table(head, rows);
}

void print(const api::Answer& answer) {
  const Diagnosis& diagnosis = answer.diagnosis;
  print_verdict(diagnosis, api::best_sentence(answer));
  print_ladder(diagnosis.ladder);
  fmt::print(
      "\nHeld-out: at the values that are best for the train trials. Predictive: with what the train trials "
      "leave open\nof the values; this one decides.\n");
  print_own_parameters(validation::own_values(diagnosis.final_stage));
  if (!diagnosis.ranking.empty()) {
    fmt::print("\nBest candidates of the first round, of {} screened:\n\n", diagnosis.candidates);
    print_rows(diagnosis.ranking, 10);
  }
  if (diagnosis.verdict != Verdict::nothing_missing && !diagnosis.leads.empty()) {
    fmt::print("\nTried last and not accepted:\n\n");
    print_rows(diagnosis.leads, 6);
  }
  print_pairs(diagnosis.pairs);
}

/// What ordinary identification makes of the same trials, and what the torques alone could tell.
void print_torques(const api::Answer& answer) {
  if (answer.standard) {
    fmt::print(
        "\nStandard identification (masses, centres of mass, inertias, gains, friction and offsets at once): "
        "train {:.3f}, held-out\n{:.3f}; {} of {} values at a limit.\n",
        answer.standard->scores.train, answer.standard->scores.held_out, answer.standard->at_limits,
        answer.standard->values);
    std::string kinds;
    for (const validation::KindShare& one : answer.standard->rests_on) {
      kinds += fmt::format("{}{} {:.4g}", kinds.empty() ? "" : ", ", one.kind, one.without);
    }
    fmt::print(
        "With one kind of value as stated and the others fitted anew, on some of the windows: {} (floors "
        "held out).\n",
        kinds);
  }
  if (answer.best) {
    const validation::WindowsFit& best = answer.best->fit;
    std::string parts = answer.best->with_named && !answer.diagnosis.accepted.empty() ? "what is named" : "";
    for (const validation::Named& one : answer.best->unnamed) {
      parts +=
          fmt::format("{}{} at {}, which is not named", parts.empty() ? "" : ", with ", one.effect, one.at);
    }
    if (answer.best->with_standard) {
      parts += parts.empty() ? "standard identification, which what is named adds nothing to"
                             : ", with standard identification of all else";
    }
    const std::string test = best.scores.test > 0.0 ? fmt::format(", test {:.3f}", best.scores.test) : "";
    fmt::print(
        "\nBest model found: {}: train {:.3f}, held-out {:.3f}{}.\nThis is what --save writes. Its {} values "
        "may make up for something that is in no law; they are no names.\n",
        parts, best.scores.train, best.scores.held_out, test, best.values);
  }
  if (answer.torque_cutoff > 0.0) {
    fmt::print(
        "\nFar from the measurements candidates are held against the torques that the motion needs, below "
        "{:.3g} Hz.\n",
        answer.torque_cutoff);
  }
  constexpr double kShown = 0.05;
  std::string names;
  for (const validation::LawShare& one : answer.open) {
    if (one.share >= kShown) {
      names += fmt::format("{}{} at {} {:.0f} %", names.empty() ? "" : ", ", one.effect, one.at,
                           100.0 * one.share);
    }
  }
  if (!names.empty()) {
    fmt::print("What they ask for beyond what is named, by share of the resamples: {}.\n", names);
  }
}

/// Long work then keeps its results in the file.
void keep_results(const Loaded& loaded, const std::string& file, const std::vector<std::string>& written) {
  if (file.empty()) {
    return;
  }
  if (std::find(written.begin(), written.end(), file) != written.end()) {
    throw InputError({file, 0, "--resume"}, "the file of --save or --json", "a file of its own");
  }
  const std::size_t found = api::keep_results(loaded, file, &workers());
  if (found > 0) {
    fmt::print(stderr, "going on from {} results in {}\n", found, file);
  }
}

}  // namespace

void add_diagnose(CLI::App& app, Outcome& /*outcome*/) {
  struct Options {
    Inputs inputs;
    std::string save, resume;
    validation::Policy diagnose;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("diagnose", "Which effect is missing, where, how sure");
  add_trial_inputs(*command, options->inputs);
  command
      ->add_option("--windows", options->inputs.most_windows,
                   "use N windows at most of the train trials and of the held-out ones each, spread evenly "
                   "over them; without it all")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command->add_option("--without", options->inputs.without, "effects to leave out of the catalogue")
      ->type_name("EFFECT");
  command->add_option("--save", options->save, "write the model with what was found as an overlay")
      ->type_name("FILE");
  command
      ->add_option("--resume", options->resume,
                   "keep results in FILE as they come, and go on from those in it")
      ->type_name("FILE");
  command
      ->add_option("--most", options->diagnose.most_effects,
                   "most effects to accept (of those that torques ask for, at each place that moves)")
      ->capture_default_str();
  command->add_option("--refits", options->diagnose.refits, "candidates refitted in each round")
      ->capture_default_str();
  command->add_option("--seed", options->diagnose.seed, "seed of the resampling")->capture_default_str();
  command->footer("Example:\n  plumbline diagnose demo/siso_mLA demo/siso_mLS demo/mimo --save found.yaml");
  command->callback([options] {
    const effects::Catalogue catalogue = api::catalogue_without(options->inputs.without);
    if (workers().is_first()) {
      check_writable(options->save);
      check_writable(options->resume);
    }
    const Loaded loaded = load(options->inputs);
    keep_results(loaded, options->resume, {options->save, options->inputs.json});
    api::share_work(loaded, workers());
    api::Answer answer;
    {
      ProgressLine progress;
      answer = api::diagnose(loaded, catalogue, options->diagnose, progress.callback());
    }
    if (!workers().is_first()) {
      return;
    }
    const Diagnosis& diagnosis = answer.diagnosis;
    write_json(api::to_json(answer), options->inputs.json);
    print(answer);
    print_torques(answer);
    print_unexplained(answer.left);
    if (loaded.data->kept && !loaded.data->kept->is_written()) {
      fmt::print(stderr, "{}: results could not be written any more; those in it stay\n", options->resume);
    }
    if (diagnosis.interrupted && !options->resume.empty()) {
      fmt::print("\nThe same command goes on from the results in {}.\n", options->resume);
    }
    if (!options->save.empty() && !diagnosis.ladder.empty()) {
      api::save(answer, loaded.model, options->save);
    }
  });
}

}  // namespace plumbline::cli
