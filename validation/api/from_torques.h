// The part of a diagnosis that needs no prediction: what the torques of the measured motion say.
#pragma once

#include <optional>

#include "validation/diagnose/diagnose.h"
#include "validation/standard/standard_fit.h"
#include "validation/standard/torque_stage.h"

namespace plumbline::api {

/// Standard identification beside a diagnosis, so that no answer is taken for more than it is.
struct StandardRung {
  validation::Scores scores;  ///< floor units
  int values = 0, at_limits = 0;
};

struct FromTorques {
  std::optional<StandardRung> standard;  ///< empty: the torques cannot be asked
  std::optional<validation::TorqueStage> stage;
};

/// Standard identification, and torque_stage() with its frequency, where the train error is above five times
/// Policy::hopeless: so far from the measurements what a window predicts says little of what is missing.
/// Nothing for a single motor, and where the torques cannot be asked (TorqueProblem).
FromTorques ask_torques(const model::Model& model, const effects::Catalogue& catalogue,
                        const validation::Data& data, const validation::Policy& policy,
                        const validation::Progress& progress);

/// The rungs and findings of a stage that names something, from "as given" on. final_stage is the last one.
validation::Diagnosis diagnosis_of(const validation::TorqueStage& stage, const model::Model& model,
                                   const validation::Data& data, const validation::Policy& policy,
                                   const validation::Progress& progress);

/// The model with the first `named` effects, from which windows are diagnosed on: what was identified, each
/// with its own deviation, replaces what was stated.
model::Model identified_model(const validation::TorqueStage& stage, std::size_t named);

/// Findings and rungs of `further`, which began at identified_model(), behind those of `first`.
void join(validation::Diagnosis further, const validation::Data& data, const validation::Policy& policy,
          validation::Diagnosis& first);

}  // namespace plumbline::api
