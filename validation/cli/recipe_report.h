// What a recipe found, for people and machines.
#pragma once

#include <nlohmann/json.hpp>

#include "validation/studies/recipes/run_recipe.h"

namespace plumbline::cli {

/// Whether a finding met the recipe's target; only where both the target and the true value are known.
enum class Verdict { none, met, missed };
Verdict verdict_of(const validation::Unknown& unknown, const validation::IdentifiedValue& finding,
                   const validation::Truth& truth);

/// True when every target of a step that is carried on was met.
bool targets_met(const validation::Recipe& recipe, const validation::RecipeResult& result);

void print_recipe(const validation::Recipe& recipe, const validation::RecipeResult& result,
                  double confidence);
nlohmann::json recipe_json(const validation::Recipe& recipe, const validation::RecipeResult& result,
                           double confidence);

}  // namespace plumbline::cli
