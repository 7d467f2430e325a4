// A recipe carried out, step by step.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "validation/identify/diagnose/screen.h"
#include "validation/studies/recipes/methods.h"

namespace plumbline::validation {

struct RecipeOptions {
  std::optional<std::uint64_t>
      seed;  ///< of true values and sensors' noise; needed where the recipe has experiments
  MethodOptions method;
};

struct RecipeResult {
  Truth truth;  ///< empty for a recipe on recorded trials alone
  std::vector<StepResult> steps;
};

/// Throws InputError when a step needs twins and there is no seed. No method sees the truth: it goes to the
/// twins and to the result only.
RecipeResult run_recipe(const Recipe& recipe, const RecipeOptions& options, const Progress& progress);

}  // namespace plumbline::validation
