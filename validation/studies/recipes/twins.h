// Robots that do not exist yet: true values drawn from a seed, and the data that such a robot would give.
#pragma once

#include <cstdint>

#include "validation/identify/predict/problem.h"
#include "validation/studies/recipes/findings.h"
#include "validation/studies/recipes/posture.h"
#include "validation/studies/recipes/recipe.h"

namespace plumbline::validation {

/// Stated value plus deviation times a standard normal number within two deviations, for each stated unknown
/// in file order.
Truth draw_truth(const Recipe& recipe, std::uint64_t seed);

/// One trial for each of the step's experiments, or one of its hops, as the robot's sensors would have
/// recorded them. Throws std::runtime_error when the robot falls before the stretch of hops is over.
std::vector<Trial> twin_trials(const Recipe& recipe, const Step& step, const Truth& truth, std::uint64_t seed,
                               const StopFlag* stop);

/// Readings of the step's postures, the hand's error included.
PostureReadings twin_postures(const Recipe& recipe, const Step& step, const Truth& truth, std::uint64_t seed);

}  // namespace plumbline::validation
