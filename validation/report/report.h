// One self-contained page about what a model predicts, where it fails, and what was found.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/identify/diagnose/diagnose.h"
#include "validation/report/repeat_json.h"
#include "validation/report/trial_json.h"

namespace plumbline::validation {

struct ReportContent {
  model::Model given;        ///< before anything was added or fitted
  std::vector<Rung> ladder;  ///< the first and the last are drawn: before and after
  nlohmann::json diagnosis;  ///< as `diagnose --json` writes it; null: compared only
  Precision precision;       ///< Diagnosis::precision
  Repetition repetition;
  DrawingOptions drawing{};
};

/// The data of the page (docs/formats.md, "The data of a report"). Throws Stopped on Ctrl-C.
nlohmann::json report_json(const ReportContent& content, const Data& data, const Progress& progress);

/// The page: HTML, its style, its scripts and these data in one text that needs nothing else.
std::string report_page(const nlohmann::json& report);

/// The models that `model` stands on and itself, each compared as it is, zero errors opened (zero_errors.h):
/// a ladder without a diagnosis. Models of one lineage have the same sensors and motors, so that the same
/// data do for all.
std::vector<Rung> lineage_ladder(const model::Model& model, const effects::Catalogue& catalogue,
                                 const Data& data, const Progress& progress);

/// A diagnosis' ladder for a page, whose errors and curves are of whole windows: of rungs that are of a part
/// of them, the first and the last are compared anew as they are, and the others say in their names of which.
std::vector<Rung> on_whole_windows(std::vector<Rung> ladder, const Data& data, const Progress& progress);

}  // namespace plumbline::validation
