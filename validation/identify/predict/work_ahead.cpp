#include "validation/identify/predict/work_ahead.h"

#include <stdexcept>

#include "validation/identify/predict/kept_results.h"
#include "work/workers.h"

namespace plumbline::validation {

int ranks_of(const Data& data) {
  return data.kept && data.kept->workers() != nullptr ? data.kept->workers()->ranks() : 1;
}

void work_ahead(const Data& data, const std::vector<Ahead>& pieces) {
  if (ranks_of(data) == 1 || pieces.empty()) {
    return;
  }
  KeptResults& kept = *data.kept;
  std::vector<work::Task> tasks;
  for (const Ahead& piece : pieces) {
    tasks.push_back({piece.name, [&kept, &piece] {
                       kept.begin_list();
                       try {
                         piece.work();
                       } catch (const Stopped&) {
                         throw;
                       } catch (const std::runtime_error&) {
                         return kept.end_list();  // what it kept before is of use
                       }
                       return kept.end_list();
                     }});
  }
  work::Watch watch;
  watch.stop = data.stop != nullptr ? &data.stop->raised : nullptr;
  // At once, so that nothing is lost of what is finished.
  watch.done = [&](std::size_t /*piece*/, const std::string& list, double /*seconds*/) { kept.take(list); };
  const work::Results results = kept.workers()->run(tasks, watch);
  if (results.stopped) {
    throw Stopped();
  }
  for (const std::string& list : results.bytes) {
    kept.take(list);
  }
}

}  // namespace plumbline::validation
