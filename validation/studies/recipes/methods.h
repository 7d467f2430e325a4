// The methods of a recipe's steps.
#pragma once

#include "validation/identify/predict/problem.h"
#include "validation/studies/recipes/findings.h"
#include "validation/studies/recipes/posture.h"
#include "validation/studies/recipes/recipe.h"

namespace plumbline::validation {

struct MethodOptions {
  double confidence = 0.95;
  int iterations = 40;
  const StopFlag* stop = nullptr;
};

/// Fits the step's free unknowns over windows of the trials; known ones move within what is known of them.
StepResult window_fit(const Recipe& recipe, const Step& step, const std::vector<Trial>& trials,
                      const KnowledgeMap& knowledge, const MethodOptions& options);

/// The same over static postures: predicted readings are those of the model's equilibrium with the motors
/// held where their encoders read; the hand's error in balancing is part of the residuals' covariance.
StepResult posture_fit(const Recipe& recipe, const Step& step, const Postures& postures,
                       const PostureReadings& readings, const KnowledgeMap& knowledge,
                       const MethodOptions& options);

/// Equations S1, S2 on each trial; several trials are averaged by their deviations.
StepResult arx(const Recipe& recipe, const Step& step, const std::vector<Trial>& trials,
               const MethodOptions& options);

StepResult equation_14(const Step& step, const KnowledgeMap& knowledge, const MethodOptions& options);

StepResult equation_22(const Recipe& recipe, const Step& step, const PostureReadings& readings,
                       const MethodOptions& options);

}  // namespace plumbline::validation
