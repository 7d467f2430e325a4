#include <fmt/core.h>

#include <cstdio>

#include "simulator/trace/error.h"
#include "validation/batch/batch.h"
#include "validation/cli/commands.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::string jobs, out = "batch", part;
};

/// "missing: coulomb@drive"; of the other modes the errors, in floors.
std::string outcome_of(const nlohmann::json& row) {
  if (row.value("status", "") != "done") {
    return row.value("why", "");
  }
  if (row.value("mode", "") != "diagnose") {
    const nlohmann::json errors = row.at("errors");
    std::string text;
    for (const char* role : {"train", "held_out"}) {
      const auto error = errors.find(role);
      if (error != errors.end() && error->is_number()) {
        text += fmt::format("{}{} {:.3f}", text.empty() ? "" : ", ", role, error->get<double>());
      }
    }
    return text;
  }
  const nlohmann::json& result = row.at("result");
  std::string text = result.value("verdict", "");
  const char* joint = ": ";
  for (const nlohmann::json& finding : result.at("accepted")) {
    text += joint + finding.value("effect", "") + "@" + finding.value("at", "");
    joint = ", ";
  }
  return text;
}

/// "3/10": the third of ten parts.
void set_part(const std::string& text, batch::BatchOptions& how) {
  int read = 0;
  if (!text.empty() && (std::sscanf(text.c_str(), "%d/%d%n", &how.part, &how.parts, &read) != 2 ||
                        read != static_cast<int>(text.size()) || how.part < 1 || how.part > how.parts)) {
    throw InputError("--part: found " + text + ", expected K/N with K from 1 to N");
  }
}

void print(const batch::BatchResult& result, const batch::BatchOptions& how) {
  std::vector<std::vector<std::string>> rows;
  for (const nlohmann::json& row : result.rows) {
    const bool is_done = row.value("status", "") == "done";
    rows.push_back(
        {row.value("label", ""), row.value("mode", ""), is_done ? "done" : "FAILED", outcome_of(row)});
  }
  print_table({"row", "mode", "", "outcome"}, rows);
  if (how.parts == 1) {
    fmt::print("\n{0}/batch.html and {0}/batch.csv: all rows together; {0}/rows: each of them.\n", how.out);
  }
  if (result.failed() > 0) {
    fmt::print("{} of {} rows failed; the same command tries them again, and them alone.\n", result.failed(),
               result.rows.size());
  }
}

void run(const Options& options, Outcome& outcome) {
  const batch::Jobs jobs = batch::read_jobs(options.jobs);
  batch::BatchOptions how;
  how.out = options.out;
  set_part(options.part, how);
  const auto ranks = static_cast<std::size_t>(workers().ranks());
  if (workers().is_first() && ranks > jobs.rows.size()) {
    fmt::print(stderr, "plumbline: {} rows for {} ranks: {} of them have nothing to do\n", jobs.rows.size(),
               ranks, ranks - jobs.rows.size());
  }
  how.workers = &workers();
  how.threads = work::cores();
  how.stop = &stop_flag();
  batch::BatchResult result;
  {
    ProgressLine progress;
    result = batch::run_batch(jobs, how, progress.callback());
  }
  print(result, how);
  outcome.status = result.failed() == 0 ? 0 : 1;
}

}  // namespace

void add_batch(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "batch", "A table of models and trials, a row a robot or a day: each diagnosed, compared or fitted");
  command->add_option("jobs", options->jobs, "the table (docs/batch.md)")->required()->type_name("FILE");
  command->add_option("-o,--out", options->out, "folder of the results; rows that it has are not run again")
      ->capture_default_str()
      ->type_name("DIR");
  command
      ->add_option("--part", options->part,
                   "only every N-th row from the K-th on, and no page: for several jobs that share a folder")
      ->type_name("K/N");
  command->footer(
      "Exit status 1 when a row failed. Examples:\n  plumbline batch jobs.yaml -o robots\n"
      "  mpirun -n 16 plumbline batch jobs.yaml -o robots");
  command->callback([options, &outcome] { run(*options, outcome); });
}

}  // namespace plumbline::cli
