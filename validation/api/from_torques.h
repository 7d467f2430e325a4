// The part of a diagnosis that needs no prediction: what the torques of the measured motion say.
#pragma once

#include <optional>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/standard/standard_fit.h"
#include "validation/identify/standard/torque_stage.h"

namespace plumbline::api {

struct FromTorques {
  std::optional<validation::StandardFit> standard;  ///< empty: not asked, or the torques cannot be
  std::optional<validation::TorqueStage> stage;
};

/// Standard identification by the torques; empty where they cannot be asked (TorqueProblem).
std::optional<validation::StandardFit> torque_identification(const model::Model& model,
                                                             const validation::Data& data,
                                                             const validation::Progress& progress);

/// Is the train error above five times Policy::hopeless? So far from the measurements what a window predicts
/// says little of what is missing; what torques tell apart there and windows do not is where masses are and
/// what hangs there.
bool is_for_torques(const validation::Scores& scores, const validation::Policy& policy);

/// Standard identification, and torque_stage() with its frequency, where the error is_for_torques(). Nothing
/// for a single motor, and where the torques cannot be asked (TorqueProblem).
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

/// Findings and rungs of `further`, which began at identified_model(), behind those of `first`. Where it has
/// none, a payload is fitted to the windows in place of a mass or centre of mass that `first` names.
void join(validation::Diagnosis further, const effects::Catalogue& catalogue, const validation::Data& data,
          const validation::Policy& policy, const validation::Progress& progress,
          validation::Diagnosis& first);

}  // namespace plumbline::api
