#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <limits>
#include <mutex>
#include <numeric>
#include <thread>

#include "work/workers.h"

namespace plumbline::work {
namespace {

bool is_raised(const Watch& watch) { return watch.stop != nullptr && watch.stop->load(); }

/// A count that a launcher left in the environment; 0: none.
int count_in_environment(const char* name) {
  const char* text = std::getenv(name);
  return text == nullptr ? 0 : std::atoi(text);
}

/// Tasks that are not known, shared out among threads.
class Queue {
 public:
  Queue(const std::vector<Task>& tasks, const Watch& watch) : tasks_(tasks), watch_(watch) {
    open_ = open_tasks(tasks, watch, results_);
  }

  std::size_t open() const { return open_.size(); }

  void work() {
    while (const std::optional<std::size_t> task = take()) {
      try {
        const auto begin = std::chrono::steady_clock::now();
        std::string bytes = tasks_[*task].run();
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
        keep(*task, std::move(bytes), took.count());
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        failure_ = failure_ ? failure_ : std::current_exception();
        next_ = open_.size();
      }
    }
  }

  Results end() {
    results_.stopped = is_raised(watch_) && done_ < open_.size();
    if (failure_ && !results_.stopped) {
      std::rethrow_exception(failure_);
    }
    return std::move(results_);
  }

 private:
  std::optional<std::size_t> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (next_ >= open_.size() || is_raised(watch_)) {
      return std::nullopt;
    }
    return open_[next_++];
  }

  void keep(std::size_t task, std::string bytes, double seconds) {
    const std::lock_guard<std::mutex> lock(mutex_);
    results_.bytes[task] = std::move(bytes);
    ++done_;
    if (watch_.done) {
      watch_.done(task, results_.bytes[task], seconds);
    }
  }

  const std::vector<Task>& tasks_;
  const Watch& watch_;
  std::vector<std::size_t> open_;
  std::size_t next_ = 0, done_ = 0;
  std::mutex mutex_;
  std::exception_ptr failure_;
  Results results_;
};

}  // namespace

Results Threads::run(const std::vector<Task>& tasks, const Watch& watch) {
  Queue queue(tasks, watch);
  std::vector<std::thread> others;
  const std::size_t threads = std::min(queue.open(), static_cast<std::size_t>(std::max(at_a_time_, 1)));
  for (std::size_t t = 1; t < threads; ++t) {
    others.emplace_back([&] { queue.work(); });
  }
  queue.work();
  for (std::thread& thread : others) {
    thread.join();
  }
  return queue.end();
}

std::vector<std::size_t> order_of(const std::vector<Task>& tasks) {
  std::vector<std::size_t> order(tasks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto length = [&](std::size_t task) {
    return tasks[task].seconds > 0.0 ? tasks[task].seconds : std::numeric_limits<double>::infinity();
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t one, std::size_t other) { return length(one) > length(other); });
  return order;
}

std::vector<std::size_t> open_tasks(const std::vector<Task>& tasks, const Watch& watch, Results& results) {
  results.bytes.resize(tasks.size());
  std::vector<std::size_t> open;
  for (const std::size_t task : order_of(tasks)) {
    std::optional<std::string> known = watch.known ? watch.known(task) : std::nullopt;
    if (known) {
      results.bytes[task] = std::move(*known);
    } else {
      open.push_back(task);
    }
  }
  return open;
}

int started_together() {
  // Open MPI's mpirun, those of MPICH's kind, and srun.
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const int count = count_in_environment(name)) {
      return count;
    }
  }
  return 1;
}

int cores() {
  const int all = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  // A rank that is bound to a core sees no other. Where it is not, the launcher says how many share the
  // machine.
  const int here =
      std::max(count_in_environment("OMPI_COMM_WORLD_LOCAL_SIZE"), count_in_environment("MPI_LOCALNRANKS"));
  return std::max(1, all / std::max(here, 1));
}

}  // namespace plumbline::work
