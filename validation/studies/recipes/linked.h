// Models whose parameters are a recipe's unknowns.
#pragma once

#include "validation/identify/predict/windows.h"
#include "validation/studies/recipes/findings.h"
#include "validation/studies/recipes/recipe.h"

namespace plumbline::validation {

/// The model with every link's parameter at the value of its unknown; unknowns that `values` does not have
/// leave the model's own value.
model::Model with_unknowns(const LinkedModel& linked, const std::map<std::string, double>& values);

/// A parameter that a step moves, and its link.
struct LinkedParameter {
  FreeParameter parameter;
  Link link;
  bool free = true;  ///< false: known, moved within what is known of it
};

/// The step's free unknowns, then the known ones that are uncertain. What is known enters as mean and
/// deviation. Parameters of one unknown move together; throws InputError when their links differ.
std::vector<LinkedParameter> linked_parameters(const LinkedModel& linked, const Step& step,
                                               const KnowledgeMap& knowledge);

std::vector<FreeParameter> parameters_of(const std::vector<LinkedParameter>& linked);

/// Unknowns' values that a step starts from: those of its known unknowns.
std::map<std::string, double> known_values(const Step& step, const KnowledgeMap& knowledge);

}  // namespace plumbline::validation
