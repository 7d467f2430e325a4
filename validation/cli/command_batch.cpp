#include <fmt/core.h>

#include "validation/batch/batch.h"
#include "validation/cli/commands.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/output.h"
#include "validation/cli/ranks.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::string jobs, out = "batch";
};

void print(const batch::BatchResult& result, const std::string& out) {
  std::vector<std::vector<std::string>> rows;
  for (const nlohmann::json& row : result.rows) {
    const bool is_done = row.value("status", "") == "done";
    const nlohmann::json of = row.value("result", nlohmann::json::object());
    const std::string verdict = of.value("summary", "");
    rows.push_back({row.value("label", ""), row.value("mode", ""), is_done ? "done" : "FAILED",
                    is_done ? verdict : row.value("why", "")});
  }
  print_table({"row", "mode", "", "outcome"}, rows);
  fmt::print("\n{0}/batch.html and {0}/batch.csv: all rows together; {0}/rows: each of them.\n", out);
  if (result.failed() > 0) {
    fmt::print("{} of {} rows failed; the same command tries them again, and them alone.\n", result.failed(),
               result.rows.size());
  }
}

void run(const Options& options, Outcome& outcome) {
  const batch::Jobs jobs = batch::read_jobs(options.jobs);
  const auto ranks = static_cast<std::size_t>(workers().ranks());
  if (workers().is_first() && ranks > jobs.rows.size()) {
    fmt::print(stderr, "plumbline: {} rows for {} ranks: {} of them have nothing to do\n", jobs.rows.size(),
               ranks, ranks - jobs.rows.size());
  }
  batch::BatchOptions how;
  how.out = options.out;
  how.workers = &workers();
  how.threads = work::cores();
  how.stop = &stop_flag();
  batch::BatchResult result;
  {
    ProgressLine progress;
    result = batch::run_batch(jobs, how, progress.callback());
  }
  print(result, options.out);
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
  command->footer(
      "Exit status 1 when a row failed. Examples:\n  plumbline batch jobs.yaml -o robots\n"
      "  mpirun -n 16 plumbline batch jobs.yaml -o robots");
  command->callback([options, &outcome] { run(*options, outcome); });
}

}  // namespace plumbline::cli
