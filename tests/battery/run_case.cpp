#include "tests/battery/run_case.h"

#include <chrono>
#include <exception>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/draw.h"
#include "tests/battery/foreign_laws.h"
#include "validation/compare/compare.h"
#include "validation/twin/twin.h"

namespace plumbline::battery {
namespace {

constexpr double kTwinTolerance = 1e-9;

/// Varies what a command does about its mean, which holds the robot against gravity, and what a controller is
/// asked to follow.
void vary_amplitudes(validation::Experiment& experiment, Draw& draw) {
  for (validation::Command& command : experiment.commands) {
    const double mean = command.values.mean();
    command.values = (mean + draw.factor() * (command.values.array() - mean)).matrix();
  }
  for (validation::Controller& controller : experiment.controllers) {
    controller.reference *= draw.factor();
  }
}

/// The case's trials in memory. Without a hidden effect the excitation differs from seed to seed instead of
/// the effect's parameters, because sensors without noise would always give the same data.
std::vector<validation::Trial> trials_of(const Case& one, const model::Model& bare, const std::string& with,
                                         Draw& draw, const RunOptions& run) {
  model::Model truth = bare;
  if (!with.empty()) {
    truth = one.kind == Kind::foreign ? with_foreign_places(bare) : bare;
    truth.effects.push_back(validation::parse_effect(with, truth, every_law()));
  }
  validation::TwinOptions options;
  options.seed = run.seed;
  options.relative_tolerance = kTwinTolerance;
  std::vector<validation::Trial> trials;
  for (const std::string& file : robot_of(one).experiments) {
    validation::Experiment experiment =
        validation::read_experiment(std::string(PLUMBLINE_ROOT) + "/" + file, bare);
    if (one.kind == Kind::none) {
      vary_amplitudes(experiment, draw);
    }
    if (!run.bare_only || experiment.role == validation::Role::held_out) {
      trials.push_back(validation::twin(truth, experiment, options));
      trials.back().name = trials.back().file = file;
    }
    ++options.seed;
  }
  return trials;
}

bool names(const Row& truth, const std::string& effect, const std::string& at) {
  return truth.effect == effect && truth.at == at;
}

void judge(const validation::Diagnosis& diagnosis, Result& result) {
  result.verdict = to_string(diagnosis.verdict);
  result.after = diagnosis.final_stage.estimate.scores.held_out;
  result.before = result.after;
  result.ranking = diagnosis.ranking;
  result.leads = diagnosis.leads;
  result.right = (result.one.kind == Kind::none && diagnosis.accepted.empty()) ||
                 ((result.one.kind == Kind::removed || result.one.kind == Kind::foreign) &&
                  diagnosis.verdict != validation::Verdict::missing);
  if (diagnosis.accepted.empty()) {
    return;
  }
  const Row& truth = result.one.row;
  const validation::Finding& first = diagnosis.accepted.front();
  result.first = first.effect + "@" + first.at;
  for (std::size_t i = 1; i < diagnosis.accepted.size(); ++i) {
    result.others += (i > 1 ? " " : "") + diagnosis.accepted[i].effect + "@" + diagnosis.accepted[i].at;
  }
  result.before = first.held_out_before;
  result.set_size = 1 + static_cast<int>(first.rivals.size());
  const bool named_first = names(truth, first.effect, first.at);
  result.in_set = named_first;
  for (const validation::Named& rival : first.rivals) {
    result.in_set = result.in_set || names(truth, rival.effect, rival.at);
  }
  if (result.one.kind == Kind::hidden) {
    result.right = named_first || (result.in_set && result.set_size <= 1 + kMostRivals);
  }
}

effects::Catalogue catalogue_of(const Case& one) {
  effects::Catalogue catalogue = model::known_effects();
  for (const std::string& law : one.removed) {
    catalogue = catalogue.without(law);
  }
  return catalogue;
}

void run(const RunOptions& options, Result& result) {
  const Case& one = result.one;
  const effects::Catalogue all = model::known_effects();
  const model::Model bare = model::read_model(std::string(PLUMBLINE_ROOT) + "/" + robot_of(one).model, all);
  Draw draw(one, options.seed);
  if (one.kind != Kind::none) {
    result.with = drawn_effect(one, every_law(), draw);
  }
  const validation::Data data(trials_of(one, bare, result.with, draw, options), {});
  result.bare = validation::compare(bare, data).scores.held_out;
  result.visible = result.bare >= kVisible;
  if (!options.bare_only) {
    const auto silent = [](const std::string& /*what*/, double /*fraction*/) {};
    judge(validation::diagnose(bare, catalogue_of(one), data, {}, silent), result);
  }
}

}  // namespace

Result run_case(const Case& one, const RunOptions& options) {
  Result result;
  result.one = one;
  const auto start = std::chrono::steady_clock::now();
  try {
    run(options, result);
  } catch (const std::exception& error) {
    result.error = error.what();
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace plumbline::battery
