// Independent runs: on threads, or on the ranks of an MPI job.
#pragma once

#include <functional>
#include <string>

#include "validation/identify/predict/problem.h"
#include "work/bytes.h"
#include "work/workers.h"

namespace plumbline::validation {

/// What is run, and how its results travel.
struct SharedRuns {
  std::string name;  ///< for the record of durations
  int count = 0;
  std::function<void(int run)> work;  ///< leaves its result where the caller wants it; on several threads
  std::function<std::string(int run)> result;                    ///< that result, as bytes
  std::function<void(int run, work::BytesReader& result)> take;  ///< puts a result there
};

/// Who runs them, and what ends them.
struct Runners {
  work::Workers* workers = nullptr;  ///< several ranks: each run by one of them; none: threads
  const StopFlag* stop = nullptr;    ///< raised: Stopped is thrown
};

/// Does runs 0 to count - 1: on all cores of this process, or among the ranks, and then all of them take all
/// results. What follows from the results is the same either way. `progress` is told how many are done, on
/// the first rank alone. Throws what the work throws; of another rank its message, as work::Failed.
void share_runs(const SharedRuns& runs, const Runners& runners,
                const std::function<void(int)>& progress = {});

}  // namespace plumbline::validation
