// A diagnosis with what it leaves unexplained, and as a model file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/api/from_torques.h"
#include "validation/api/loading.h"
#include "validation/diagnose/diagnose.h"
#include "validation/diagnose/unexplained.h"

namespace plumbline::api {

struct Answer {
  validation::Diagnosis diagnosis;
  std::vector<validation::UnexplainedForce> left;  ///< empty when little is left or the work was stopped
  std::optional<StandardRung> standard;            ///< empty: at the floor, or the torques cannot be asked
  std::vector<validation::TorqueShare> open;       ///< what the torques ask for and cannot tell apart
  double torque_cutoff = 0.0;  ///< Hz: below which torques were compared; 0: they were not
};

Answer diagnose(const Loaded& loaded, const effects::Catalogue& catalogue, const validation::Policy& options,
                const validation::Progress& progress);

/// docs/formats/json-results.md, `diagnose`.
nlohmann::json to_json(const Answer& answer);

/// The accepted effects and the model's own numbers that moved, as an overlay on the model that was given. A
/// mass or an inertia that was named beside a number of the model that stated an uncertainty is one number
/// with it.
void save(const validation::Diagnosis& diagnosis, const model::Model& given, const std::string& file);

}  // namespace plumbline::api
