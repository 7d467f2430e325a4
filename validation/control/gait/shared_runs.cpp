#include "validation/control/gait/shared_runs.h"

#include <fmt/core.h>

#include <atomic>

namespace plumbline::validation {
namespace {

void on_threads(const SharedRuns& runs, const std::function<void(int)>& progress) {
  std::atomic<int> done{0};
  parallel_for(runs.count, work::cores(), [&](int run) {
    runs.work(run);
    const int count = ++done;
    if (progress) {
      progress(count);
    }
  });
}

}  // namespace

void share_runs(const SharedRuns& runs, const Runners& runners, const std::function<void(int)>& progress) {
  if (runners.workers == nullptr || runners.workers->ranks() == 1) {
    on_threads(runs, progress);
    return;
  }
  std::vector<work::Task> tasks;
  for (int run = 0; run < runs.count; ++run) {
    tasks.push_back({fmt::format("{} {}", runs.name, run), [&runs, run] {
                       runs.work(run);
                       return runs.result(run);
                     }});
  }
  int done = 0;
  work::Watch watch;
  watch.stop = runners.stop != nullptr ? &runners.stop->raised : nullptr;
  watch.done = [&](std::size_t /*run*/, const std::string& /*result*/, double /*seconds*/) {
    ++done;
    if (progress) {
      progress(done);
    }
  };
  const work::Results results = runners.workers->run(tasks, watch);
  if (results.stopped) {
    throw Stopped();
  }
  for (int run = 0; run < runs.count; ++run) {
    work::BytesReader reader(results.bytes[static_cast<std::size_t>(run)]);
    runs.take(run, reader);
  }
}

}  // namespace plumbline::validation
