#include <fmt/core.h>

#include "simulator/model/known_effects.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/table.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/report/report.h"
#include "validation/report/result_json.h"

namespace plumbline::cli {
namespace {

using validation::Progress;
using validation::ReportContent;

struct Options {
  Inputs inputs;
  std::string out;
  std::string diagnosis;  ///< a file of `diagnose --json`
  bool no_diagnose = false;
  validation::DiagnoseOptions diagnose;
};

/// A saved diagnosis; what the page reads of it must be there.
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

/// Runs the diagnosis; its ladder is the page's.
void diagnose(const Options& options, const Loaded& loaded, const Progress& progress,
              ReportContent& content) {
  validation::Diagnosis diagnosis = validation::diagnose(loaded.model, catalogue_for(options.inputs),
                                                         *loaded.data, options.diagnose, progress);
  if (diagnosis.interrupted) {
    throw validation::Stopped();  // half a page would look like a whole one
  }
  content.diagnosis = validation::to_json(diagnosis, {});  // the page has these forces by themselves
  content.precision = diagnosis.precision;
  content.ladder = validation::on_whole_windows(std::move(diagnosis.ladder), *loaded.data, progress);
  content.repetition.resampled = true;
  content.repetition.seed = options.diagnose.seed;
}

ReportContent content_of(const Options& options, const Loaded& loaded, const std::vector<std::string>& words,
                         const Progress& progress) {
  ReportContent content;
  content.given = loaded.model;
  content.repetition.command = words;
  content.repetition.models = loaded.model.lineage;
  content.repetition.window = options.inputs.window;
  if (!options.no_diagnose && options.diagnosis.empty()) {
    diagnose(options, loaded, progress, content);
    return content;
  }
  if (!options.diagnosis.empty()) {
    content.diagnosis = read_diagnosis(options.diagnosis);
    content.repetition.others.push_back(options.diagnosis);
  }
  content.ladder = validation::lineage_ladder(loaded.model, model::known_effects(), *loaded.data, progress);
  return content;
}

std::vector<std::string> files_read(const Options& options, const Loaded& loaded) {
  std::vector<std::string> files = loaded.model.lineage;
  files.push_back(loaded.model.skeleton.file);
  for (const validation::Trial& trial : loaded.data->trials) {
    files.push_back(trial.file);
    files.push_back(trial.data_file);
  }
  if (!options.diagnosis.empty()) {
    files.push_back(options.diagnosis);
  }
  return files;
}

void print(const nlohmann::json& report, const std::string& file, std::size_t bytes) {
  if (!report["diagnosis"].is_null()) {
    fmt::print("{}\n", report["diagnosis"]["summary"].get<std::string>());
  }
  fmt::print("Report: {} ({:.1f} MB; open it in a browser)\n", file, static_cast<double>(bytes) / 1e6);
}

void run(const Options& options, const std::vector<std::string>& words) {
  check_writable(options.out);
  if (!options.diagnosis.empty()) {
    read_diagnosis(options.diagnosis);  // before the work, not after it
  }
  const Loaded loaded = load(options.inputs, model::known_effects());
  check_not_an_input(options.out, files_read(options, loaded));
  nlohmann::json report;
  {
    ProgressLine progress;
    const Progress show = progress.callback();
    report = validation::report_json(content_of(options, loaded, words, show), *loaded.data, show);
  }
  const std::string page = validation::report_page(report);
  write_text_atomically(options.out, page);
  write_json({{"file", options.out},
              {"bytes", page.size()},
              {"trials", report["trials"].size()},
              {"ladder", report["ladder"]}},
             options.inputs.json);
  print(report, options.out, page.size());
}

void add_options(CLI::App& command, Options& options) {
  add_trial_inputs(command, options.inputs);
  command.add_option("-o,--out", options.out, "the page, one HTML file")->required()->type_name("FILE");
  CLI::Option* none = command.add_flag("--no-diagnose", options.no_diagnose,
                                       "compare only: the model and those it stands on");
  command
      .add_option("--diagnosis", options.diagnosis,
                  "show this result of diagnose --json instead of diagnosing again; --model is then what "
                  "diagnose --save wrote")
      ->type_name("FILE")
      ->excludes(none);
  command.add_option("--without", options.inputs.without, "effects to leave out of the catalogue")
      ->type_name("EFFECT");
  command.add_option("--most", options.diagnose.most_effects, "most effects to accept")
      ->capture_default_str();
  command.add_option("--seed", options.diagnose.seed, "seed of the resampling")->capture_default_str();
}

}  // namespace

void add_report(CLI::App& app, const std::vector<std::string>& words) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("report", "One self-contained page: where the model fails and what was found");
  add_options(*command, *options);
  command->footer("Example:\n  plumbline report demo/siso_mLA demo/siso_mLS demo/mimo -o report.html");
  command->callback([options, words] { run(*options, words); });
}

}  // namespace plumbline::cli
