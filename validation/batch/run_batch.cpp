#include <algorithm>
#include <filesystem>

#include "simulator/trace/error.h"
#include "simulator/trace/table.h"
#include "validation/batch/batch.h"
#include "validation/batch/batch_page.h"
#include "work/durations.h"

namespace plumbline::batch {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

void make_folder(const std::string& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed || !fs::is_directory(folder)) {
    throw InputError({folder, 0, ""}, failed ? failed.message() : "no folder",
                     "a folder that can be written");
  }
}

std::vector<work::Task> tasks_of(const std::vector<Row>& rows, const BatchOptions& options,
                                 const work::Durations& durations) {
  std::vector<work::Task> tasks;
  for (const Row& row : rows) {
    tasks.push_back(
        {row.label, [&row, &options] { return run_row(row, options).dump(); }, durations.of(row.label)});
  }
  return tasks;
}

std::vector<Row> part_of(const std::vector<Row>& rows, const BatchOptions& options) {
  std::vector<Row> some;
  for (std::size_t r = static_cast<std::size_t>(options.part) - 1; r < rows.size();
       r += static_cast<std::size_t>(options.parts)) {
    some.push_back(rows[r]);
  }
  return some;
}

/// What all rows say together; only where all of them are here.
void write_together(const Jobs& jobs, const BatchOptions& options, const std::vector<json>& rows) {
  write_text_atomically(options.out + "/batch.csv", csv_of(rows));
  write_text_atomically(options.out + "/batch.html", page_of(jobs.title, rows));
  std::error_code none;
  if (fs::is_empty(options.out + "/kept", none)) {
    fs::remove(options.out + "/kept", none);
  }
}

}  // namespace

std::size_t BatchResult::failed() const {
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const json& row) { return row.value("status", "") != "done"; }));
}

BatchResult run_batch(const Jobs& jobs, const BatchOptions& options, const validation::Progress& progress) {
  work::Workers& workers = *options.workers;
  if (workers.is_first()) {
    for (const char* part : {"", "/rows", "/kept"}) {
      make_folder(options.out + part);
    }
  }
  workers.check_shared(options.out);
  const bool is_whole = options.parts == 1;
  const std::vector<Row> rows = part_of(jobs.rows, options);
  const std::string times = options.out + "/durations.csv";
  work::Durations durations(times);
  std::size_t done = 0;
  work::Watch watch;
  watch.stop = &options.stop->raised;
  watch.done = [&](std::size_t task, const std::string& /*row*/, double seconds) {
    durations.add(rows[task].label, seconds);
    progress(rows[task].label, static_cast<double>(++done) / static_cast<double>(rows.size()));
  };
  const work::Results results = workers.run(tasks_of(rows, options, durations), watch);
  if (workers.is_first() && is_whole) {
    write_text_atomically(times, durations.text("label"));
  }
  if (results.stopped) {
    throw validation::Stopped();
  }
  BatchResult batch;
  for (const std::string& row : results.bytes) {
    batch.rows.push_back(json::parse(row));
  }
  if (workers.is_first() && is_whole) {
    write_together(jobs, options, batch.rows);
  }
  return batch;
}

}  // namespace plumbline::batch
