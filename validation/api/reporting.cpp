#include "validation/api/reporting.h"

#include "simulator/model/known_effects.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "validation/report/report.h"
#include "validation/report/result_json.h"

namespace plumbline::api {
namespace {

using validation::Progress;
using validation::ReportContent;

/// Runs the diagnosis; its ladder is the page's.
void diagnose(const Loaded& loaded, const effects::Catalogue& catalogue, const ReportRequest& request,
              const Progress& progress, ReportContent& content) {
  validation::Diagnosis diagnosis =
      validation::diagnose(loaded.model, catalogue, *loaded.data, request.diagnose, progress);
  if (diagnosis.interrupted) {
    throw validation::Stopped();
  }
  content.diagnosis = validation::to_json(diagnosis, {});  // the page has these forces by themselves
  content.precision = diagnosis.precision;
  content.ladder = validation::on_whole_windows(std::move(diagnosis.ladder), *loaded.data, progress);
  content.repetition.resampled = true;
  content.repetition.seed = request.diagnose.seed;
}

}  // namespace

nlohmann::json read_diagnosis(const std::string& file) {
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(read_text(file));
  } catch (const nlohmann::json::parse_error&) {
    throw InputError({file, 0, ""}, "something that is no JSON", "what diagnose --json wrote");
  }
  for (const char* key : {"verdict", "summary", "accepted", "ranking", "leads", "ladder", "candidates"}) {
    if (!json.is_object() || !json.contains(key)) {
      throw InputError({file, 0, key}, "no such key", "what diagnose --json wrote");
    }
  }
  return json;
}

nlohmann::json report(const Loaded& loaded, const effects::Catalogue& catalogue, const ReportRequest& request,
                      const Progress& progress) {
  ReportContent content;
  content.given = loaded.model;
  content.repetition.command = request.command;
  content.repetition.models = loaded.model.lineage;
  content.repetition.window = loaded.data->predict.window;
  if (!request.no_diagnose && request.diagnosis.empty()) {
    diagnose(loaded, catalogue, request, progress, content);
  } else {
    if (!request.diagnosis.empty()) {
      content.diagnosis = read_diagnosis(request.diagnosis);
      content.repetition.others.push_back(request.diagnosis);
    }
    content.ladder = validation::lineage_ladder(loaded.model, model::known_effects(), *loaded.data, progress);
  }
  return validation::report_json(content, *loaded.data, progress);
}

}  // namespace plumbline::api
