#include <fmt/core.h>

#include "simulator/trace/table.h"
#include "validation/api/reporting.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/report/report.h"

namespace plumbline::cli {
namespace {

struct Options {
  Inputs inputs;
  std::string out;
  api::ReportRequest request;
};

std::vector<std::string> files_read(const Options& options, const Loaded& loaded) {
  std::vector<std::string> files = api::files_of(loaded);
  if (!options.request.diagnosis.empty()) {
    files.push_back(options.request.diagnosis);
  }
  return files;
}

void print(const nlohmann::json& report, const std::string& file, std::size_t bytes) {
  if (!report["diagnosis"].is_null()) {
    fmt::print("{}\n", report["diagnosis"]["summary"].get<std::string>());
  }
  fmt::print("Report: {} ({:.1f} MB; open it in a browser)\n", file, static_cast<double>(bytes) / 1e6);
}

void run(const Options& options) {
  check_writable(options.out);
  if (!options.request.diagnosis.empty()) {
    api::read_diagnosis(options.request.diagnosis);  // before the work, not after it
  }
  const Loaded loaded = load(options.inputs);
  check_not_an_input(options.out, files_read(options, loaded));
  nlohmann::json report;
  {
    ProgressLine progress;
    report = api::report(loaded, api::catalogue_without(options.inputs.without), options.request,
                         progress.callback());
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
  command
      .add_option("--windows", options.inputs.most_windows,
                  "use N windows at most of the train trials and of the held-out ones each, as diagnose does")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  command.add_option("-o,--out", options.out, "the page, one HTML file")->required()->type_name("FILE");
  CLI::Option* none = command.add_flag("--no-diagnose", options.request.no_diagnose,
                                       "compare only: the model and those it stands on");
  command
      .add_option("--diagnosis", options.request.diagnosis,
                  "show this result of diagnose --json instead of diagnosing again; --model is then what "
                  "diagnose --save wrote")
      ->type_name("FILE")
      ->excludes(none);
  command.add_option("--without", options.inputs.without, "effects to leave out of the catalogue")
      ->type_name("EFFECT");
  command
      .add_option("--most", options.request.diagnose.most_effects,
                  "most effects to accept (of those that torques ask for, at each place that moves)")
      ->capture_default_str();
  command.add_option("--seed", options.request.diagnose.seed, "seed of the resampling")
      ->capture_default_str();
}

}  // namespace

void add_report(CLI::App& app, const std::vector<std::string>& words) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("report", "One self-contained page: where the model fails and what was found");
  add_options(*command, *options);
  command->footer("Example:\n  plumbline report demo/siso_mLA demo/siso_mLS demo/mimo -o report.html");
  options->request.command = words;
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
