// The report's page about loaded trials.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/api/loading.h"
#include "validation/identify/diagnose/diagnose.h"

namespace plumbline::api {

struct ReportRequest {
  std::string diagnosis;     ///< a file of `diagnose --json` to show in place of a new diagnosis
  bool no_diagnose = false;  ///< compare only: the model and those that it stands on
  validation::Policy diagnose;
  std::vector<std::string> command;  ///< what made it, for whoever wants to repeat it
};

/// A saved diagnosis; what the page reads of it must be there. Throws InputError.
nlohmann::json read_diagnosis(const std::string& file);

/// The data of the page (docs/formats/json-results.md, "The data of a report"); validation::report_page makes
/// a page of them. Throws Stopped on Ctrl-C: half a page would look like a whole one.
nlohmann::json report(const Loaded& loaded, const effects::Catalogue& catalogue, const ReportRequest& request,
                      const validation::Progress& progress);

}  // namespace plumbline::api
