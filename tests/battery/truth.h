// The robot of a case, with what is hidden in it, and what its sensors record.
#pragma once

#include <string>
#include <vector>

#include "tests/battery/draw.h"
#include "tests/battery/run_case.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::battery {

/// The robot with what the case hides in it, and what that is.
struct Truth {
  model::Model robot;
  std::vector<model::EffectUse> hidden;
  std::string text;  ///< Result::with
};

/// `bare`: the model as the diagnosis will see it.
Truth truth_of(const Case& one, const model::Model& bare, Draw& draw, const RunOptions& run);

/// The case's trials in memory. Without a hidden effect the excitation differs from seed to seed instead of
/// the effect's parameters, because sensors without noise would always give the same data. Hops begin
/// differently in every case.
std::vector<validation::Trial> trials_of(const Case& one, const model::Model& bare, const Truth& truth,
                                         Draw& draw, const RunOptions& run);

}  // namespace plumbline::battery
