// A diagnosis with what it leaves unexplained, and as a model file.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/api/from_torques.h"
#include "validation/api/loading.h"
#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/diagnose/unexplained.h"
#include "validation/identify/standard/standard_windows.h"

namespace plumbline::api {

/// Standard identification beside a diagnosis, so that no answer is taken for more than it is.
struct StandardRung {
  validation::Scores scores;  ///< floor units
  int values = 0, at_limits = 0;
  std::vector<validation::KindShare> rests_on;  ///< on some of the windows
};

/// The model that predicts the held-out trials best, where it is not what the diagnosis has named: with an
/// effect that was refused as a name, with everything that standard identification frees, or both.
struct BestModel {
  validation::WindowsFit fit;
  bool with_named = false;                 ///< what was named is in it
  bool with_standard = true;               ///< all that standard identification frees is in it
  std::vector<validation::Named> unnamed;  ///< effects that are in it for their prediction only
};

struct Answer {
  validation::Diagnosis diagnosis;
  std::vector<validation::UnexplainedForce> left;  ///< empty when little is left or the work was stopped
  std::optional<StandardRung> standard;            ///< empty: at the floor, or it cannot be done
  std::optional<BestModel> best;                   ///< empty: the final stage of the diagnosis
  std::vector<validation::LawShare> open;          ///< what the torques ask for and cannot tell apart
  double torque_cutoff = 0.0;  ///< Hz: below which torques were compared; 0: they were not
};

Answer diagnose(const Loaded& loaded, const effects::Catalogue& catalogue, const validation::Policy& options,
                const validation::Progress& progress);

/// The diagnosis with the best model found as its last stage.
validation::Diagnosis with_best(const Answer& answer);

/// Where nothing is named and a model was found all the same: what it is, and on what it rests; else empty.
std::string best_sentence(const Answer& answer);

/// docs/formats/json-results.md, `diagnose`.
nlohmann::json to_json(const Answer& answer);

/// The best model found, as an overlay on the model that was given: the accepted effects, the model's own
/// numbers that moved, and what standard identification has moved where it is in it. A mass or an inertia
/// that was named beside a number of the model that stated an uncertainty is one number with it.
void save(const Answer& answer, const model::Model& given, const std::string& file);
/// The same of the diagnosis' last stage.
void save(const validation::Diagnosis& diagnosis, const model::Model& given, const std::string& file);

}  // namespace plumbline::api
