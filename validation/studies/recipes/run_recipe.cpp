#include "validation/studies/recipes/run_recipe.h"

#include <chrono>
#include <utility>

#include "simulator/trace/error.h"
#include "validation/identify/inverse_model/inverse_model.h"
#include "validation/studies/recipes/twins.h"

namespace plumbline::validation {
namespace {

/// What one step measured; later steps may use it too.
struct StepData {
  std::vector<Trial> trials;
  Postures postures;
  PostureReadings readings;
};

std::vector<Trial> recorded(const Recipe& recipe, const Step& step) {
  const model::Model& model = recipe.model(step.robot).model;
  std::vector<Trial> trials;
  for (const std::string& path : step.trials) {
    trials.push_back(read_trial(path, model));
    check_command_units(model, trials.back());
  }
  check_roles(trials);
  return trials;
}

/// A seed of its own for each step: far from those of the neighbouring seeds.
std::uint64_t seed_of(std::uint64_t seed, std::size_t step) {
  return 1000003ULL * seed + 101ULL * (step + 1);
}

StepData measure(const Recipe& recipe, const Step& step, std::size_t index, const RecipeOptions& options,
                 const Truth& truth) {
  StepData data;
  if (!step.trials.empty()) {
    data.trials = recorded(recipe, step);
  } else if (step.postures) {
    data.postures = *step.postures;
    data.readings = twin_postures(recipe, step, truth, seed_of(*options.seed, index));
  } else if (step.runs || !step.experiments.empty()) {
    data.trials = twin_trials(recipe, step, truth, seed_of(*options.seed, index), options.method.stop);
  }
  return data;
}

StepResult carry_out(const Recipe& recipe, const Step& step, const StepData& data,
                     const KnowledgeMap& knowledge, const MethodOptions& options) {
  if (step.method == "window_fit" || step.method == "information") {
    return window_fit(recipe, step, data.trials, knowledge, options);
  }
  if (step.method == "posture_fit") {
    return posture_fit(recipe, step, data.postures, data.readings, knowledge, options);
  }
  if (step.method == "arx") {
    return arx(recipe, step, data.trials, options);
  }
  if (step.method == "equation_14") {
    return equation_14(step, knowledge, options);
  }
  return equation_22(recipe, step, data.readings, options);
}

void carry_on(const StepResult& result, KnowledgeMap& knowledge) {
  for (const auto* list : {&result.findings, &result.updated}) {
    for (const IdentifiedValue& finding : *list) {
      if (finding.seen) {
        knowledge[finding.unknown] = {finding.value, finding.deviation};
      }
    }
  }
}

void check_seed(const Recipe& recipe, const RecipeOptions& options) {
  for (const Step& step : recipe.steps) {
    if (!options.seed && (step.runs || step.postures || !step.experiments.empty())) {
      throw InputError(step.place, "step \"" + step.name + "\", which is played by a twin, and no seed",
                       "--seed for the twin's true values, or recorded trials");
    }
  }
}

bool needs_truth(const Recipe& recipe) {
  for (const Step& step : recipe.steps) {
    if (step.runs || step.postures || !step.experiments.empty()) {
      return true;
    }
  }
  return false;
}

}  // namespace

RecipeResult run_recipe(const Recipe& recipe, const RecipeOptions& options, const Progress& progress) {
  check_seed(recipe, options);
  RecipeResult result;
  if (needs_truth(recipe)) {
    result.truth = draw_truth(recipe, *options.seed);
  }
  KnowledgeMap knowledge;
  for (const Unknown& unknown : recipe.unknowns) {
    if (unknown.stated) {
      knowledge[unknown.name] = {unknown.value, unknown.deviation};
    }
  }
  std::map<std::string, StepData> data;
  for (std::size_t i = 0; i < recipe.steps.size(); ++i) {
    const Step& step = recipe.steps[i];
    progress(step.title, static_cast<double>(i) / static_cast<double>(recipe.steps.size()));
    const auto begin = std::chrono::steady_clock::now();
    data[step.name] =
        step.data_of.empty() ? measure(recipe, step, i, options, result.truth) : data[step.data_of];
    result.steps.push_back(carry_out(recipe, step, data[step.name], knowledge, options.method));
    result.steps.back().seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (step.carried) {
      carry_on(result.steps.back(), knowledge);
    }
  }
  return result;
}

}  // namespace plumbline::validation
