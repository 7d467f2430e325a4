// Every row of a batch diagnosed, compared or fitted, and what all of them say together.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/batch/jobs.h"
#include "validation/identify/diagnose/screen.h"
#include "validation/identify/predict/problem.h"
#include "work/workers.h"

namespace plumbline::batch {

struct BatchOptions {
  std::string out;                   ///< folder; made if it is not there
  int part = 1, parts = 1;           ///< only the rows part, part + parts, ...: no page and no table then
  work::Workers* workers = nullptr;  ///< each row is one of their tasks
  int threads = 1;                   ///< within a row
  const validation::StopFlag* stop = nullptr;
};

struct BatchResult {
  std::vector<nlohmann::json> rows;  ///< docs/batch.md, `rows/LABEL.json`
  std::size_t failed() const;
};

/// Runs every row that `out` does not have from the same inputs and the same program. Each row's JSON is
/// written when it is finished, by the rank that ran it; what a diagnosis has found out on its way is kept,
/// too. A row that fails says why and does not stop the rest. The first rank then writes batch.csv and
/// batch.html. Throws Stopped when stopped, InputError when `out` cannot be written.
BatchResult run_batch(const Jobs& jobs, const BatchOptions& options, const validation::Progress& progress);

/// One row as JSON; the same bytes wherever it runs.
nlohmann::json run_row(const Row& row, const BatchOptions& options);

}  // namespace plumbline::batch
