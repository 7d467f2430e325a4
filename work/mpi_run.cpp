#include "work/mpi_run.h"

#include <mpi.h>
#include <time.h>

#include <algorithm>
#include <array>
#include <condition_variable>
#include <cstdint>
#include <cstring>
#include <exception>
#include <mutex>

namespace plumbline::work {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRequest = 1;  // to the first rank: a result, and give me a task
constexpr int kAnswer = 2;   // from it: a task, or how the run ended

constexpr std::int64_t kNone = -1;  // no task in a request
constexpr std::int64_t kEnd = -1, kStopped = -2, kFailed = -3;

enum class Kind : std::int32_t { first_request, result, stopped, failed };

struct RequestHead {
  std::uint64_t list = 0;  // of the names of all tasks
  std::int64_t task = kNone;
  Kind kind = Kind::first_request;
  double seconds = 0.0, processor = 0.0;
};

struct Finished {
  std::int64_t task = kNone;
  Kind kind = Kind::first_request;
  double seconds = 0.0, processor = 0.0;  // of the task; of its thread
  std::string bytes{};                    // the result, or the message of a failure
  std::exception_ptr failure{};
};

/// Of this thread.
double processor_seconds() {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  constexpr double kNano = 1e-9;
  return static_cast<double>(time.tv_sec) + kNano * static_cast<double>(time.tv_nsec);
}

/// Set while this thread is within a task.
bool& within_task() {
  thread_local bool within = false;
  return within;
}

std::uint64_t list_of(const std::vector<Task>& tasks) {
  std::string names;
  for (const Task& task : tasks) {
    names += task.name + '\n';
  }
  return std::hash<std::string>()(names);
}

Finished done(const std::vector<Task>& tasks, std::int64_t index, const Watch& watch) {
  const Task& task = tasks[static_cast<std::size_t>(index)];
  const auto begin = Clock::now();
  const double before = processor_seconds();
  Finished finished;
  finished.task = index;
  finished.kind = Kind::result;
  within_task() = true;
  try {
    finished.bytes = task.run();
  } catch (const std::exception& error) {
    finished.kind = watch.stop != nullptr && watch.stop->load() ? Kind::stopped : Kind::failed;
    finished.bytes = error.what();
    finished.failure = std::current_exception();
  }
  within_task() = false;
  finished.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
  finished.processor = processor_seconds() - before;
  return finished;
}

/// The thread on which the first rank does tasks while it hands out others.
class Helper {
 public:
  explicit Helper(std::function<Finished(std::int64_t)> work)
      : work_(std::move(work)), thread_([this] { loop(); }) {}
  ~Helper() {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      ended_ = true;
    }
    changed_.notify_one();
    thread_.join();
  }
  Helper(const Helper&) = delete;
  Helper& operator=(const Helper&) = delete;

  bool is_idle() const { return !busy_; }
  void give(std::int64_t task) {
    busy_ = true;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      task_ = task;
    }
    changed_.notify_one();
  }
  std::optional<Finished> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::optional<Finished> taken = std::move(finished_);
    finished_.reset();
    busy_ = busy_ && !taken;
    return taken;
  }

 private:
  void loop() {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      changed_.wait(lock, [&] { return ended_ || task_ != kNone; });
      if (ended_) {
        return;
      }
      const std::int64_t task = task_;
      task_ = kNone;
      lock.unlock();
      Finished finished = work_(task);
      lock.lock();
      finished_ = std::move(finished);
    }
  }

  std::function<Finished(std::int64_t)> work_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::int64_t task_ = kNone;
  std::optional<Finished> finished_;
  bool ended_ = false, busy_ = false;
  std::thread thread_;
};

void send_answer(int rank, std::int64_t answer) {
  MPI_Send(&answer, 1, MPI_INT64_T, rank, kAnswer, MPI_COMM_WORLD);
}

std::string receive_bytes(const MPI_Status& status) {
  int count = 0;
  MPI_Get_count(&status, MPI_BYTE, &count);
  std::string bytes(static_cast<std::size_t>(count), '\0');
  MPI_Recv(bytes.data(), count, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return bytes;
}

std::string joined(const std::vector<std::string>& parts) {
  std::string bytes;
  for (const std::string& part : parts) {
    const auto size = static_cast<std::uint64_t>(part.size());
    bytes.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes += part;
  }
  return bytes;
}

std::vector<std::string> split(const std::string& bytes) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at, sizeof size);
    parts.push_back(bytes.substr(at + sizeof size, size));
    at += sizeof size + size;
  }
  return parts;
}

/// One run() on the first rank.
class Lead {
 public:
  Lead(const std::vector<Task>& tasks, const Watch& watch, int ranks, Times& times)
      : tasks_(tasks),
        watch_(watch),
        times_(times),
        list_(list_of(tasks)),
        waiting_(static_cast<std::size_t>(ranks), false),
        given_(tasks.size(), 0.0),
        helper_([this](std::int64_t task) { return done(tasks_, task, watch_); }) {
    waiting_[0] = true;
    const std::vector<std::size_t> open = open_tasks(tasks, watch, results_);
    open_.assign(open.begin(), open.end());
  }

  Results run() {
    Pause pause;
    while (!is_complete()) {
      look_for_stop();
      feed();
      receive() ? pause.reset() : pause.wait();
    }
    tell_all();
    if (failed_ && !results_.stopped) {
      failed_->failure ? std::rethrow_exception(failed_->failure) : throw Failed(failed_->bytes);
    }
    return std::move(results_);
  }

 private:
  bool is_over() const { return results_.stopped || failed_; }
  bool is_complete() const {
    const bool is_done = out_ == 0 && (next_ == open_.size() || is_over());
    return is_done && (std::all_of(waiting_.begin(), waiting_.end(), [](bool one) { return one; }) ||
                       (results_.stopped && Clock::now() > give_up_));
  }

  /// A rank that was stopped elsewhere in the program does not come here any more: it is not waited for.
  void look_for_stop() {
    constexpr std::chrono::seconds kPatience(5);
    if (!results_.stopped && watch_.stop != nullptr && watch_.stop->load()) {
      results_.stopped = true;
      give_up_ = Clock::now() + kPatience;
    }
  }

  void feed() {
    for (std::size_t r = waiting_.size(); r-- > 0;) {  // the others first, which wait for longer
      if (!waiting_[r] || next_ == open_.size() || is_over() || (r == 0 && !helper_.is_idle())) {
        continue;
      }
      const std::int64_t task = open_[next_++];
      given_[static_cast<std::size_t>(task)] = times_.now();
      waiting_[r] = false;
      ++out_;
      r == 0 ? helper_.give(task) : send_answer(static_cast<int>(r), task);
    }
  }

  bool receive() {
    if (std::optional<Finished> own = helper_.take()) {
      keep(std::move(*own), 0);
      return true;
    }
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &is_there, &status);
    if (is_there == 0) {
      return false;
    }
    const std::string message = receive_bytes(status);
    if (status.MPI_TAG == kFailure) {
      throw Refused(message);
    }
    RequestHead head;
    std::memcpy(&head, message.data(), sizeof head);
    if (head.list != list_) {
      throw Failed(
          "rank " + std::to_string(status.MPI_SOURCE) +
          " has come to other tasks than the first rank; the ranks must be alike (processors, files)");
    }
    Finished finished;
    finished.task = head.task;
    finished.kind = head.kind;
    finished.seconds = head.seconds;
    finished.processor = head.processor;
    finished.bytes = message.substr(sizeof head);
    keep(std::move(finished), status.MPI_SOURCE);
    return true;
  }

  void keep(Finished finished, int rank) {
    waiting_[static_cast<std::size_t>(rank)] = true;
    if (finished.kind == Kind::first_request) {
      return;
    }
    --out_;
    if (finished.kind == Kind::result) {
      const auto task = static_cast<std::size_t>(finished.task);
      times_.add(tasks_[task].name, rank, given_[task], finished.seconds, finished.processor);
      results_.bytes[task] = std::move(finished.bytes);
      if (watch_.done) {
        watch_.done(task, results_.bytes[task], finished.seconds);
      }
    } else if (finished.kind == Kind::failed) {
      failed_ = failed_ ? std::move(failed_) : std::move(finished);
    } else {
      results_.stopped = true;
      give_up_ = Clock::now();
    }
  }

  void tell_all() {
    const bool is_failed = failed_ && !results_.stopped;
    const std::int64_t answer = results_.stopped ? kStopped : is_failed ? kFailed : kEnd;
    for (std::size_t r = 1; r < waiting_.size(); ++r) {
      if (waiting_[r]) {
        send_answer(static_cast<int>(r), answer);
      }
    }
    if (!results_.stopped) {
      std::string bytes = is_failed ? failed_->bytes : joined(results_.bytes);
      broadcast(bytes);
    }
  }

  const std::vector<Task>& tasks_;
  const Watch& watch_;
  Times& times_;
  std::uint64_t list_;
  std::vector<bool> waiting_;         // for a task, by rank
  std::vector<double> given_;         // when, by task
  std::vector<std::int64_t> open_{};  // in the order in which they are given away
  std::size_t next_ = 0;
  int out_ = 0;  // given away and not back
  std::optional<Finished> failed_{};
  Clock::time_point give_up_{};
  Results results_{};
  Helper helper_;
};

}  // namespace

Results lead(const std::vector<Task>& tasks, const Watch& watch, int ranks, Times& times) {
  return Lead(tasks, watch, ranks, times).run();
}

Results follow(const std::vector<Task>& tasks, const Watch& watch) {
  Finished finished;
  RequestHead head;
  head.list = list_of(tasks);
  std::int64_t answer = 0;
  while (true) {
    head.task = finished.task;
    head.kind = finished.kind;
    head.seconds = finished.seconds;
    head.processor = finished.processor;
    std::string message(sizeof head, '\0');
    std::memcpy(message.data(), &head, sizeof head);
    message += finished.bytes;
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_BYTE, 0, kRequest, MPI_COMM_WORLD);
    Pause pause;
    for (int is_there = 0; is_there == 0; pause.wait()) {
      MPI_Iprobe(0, kAnswer, MPI_COMM_WORLD, &is_there, MPI_STATUS_IGNORE);
    }
    MPI_Recv(&answer, 1, MPI_INT64_T, 0, kAnswer, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    if (answer < 0) {
      break;
    }
    finished = done(tasks, answer, watch);
  }
  Results results;
  results.stopped = answer == kStopped;
  if (results.stopped) {
    results.bytes.resize(tasks.size());
    return results;
  }
  std::string bytes;
  broadcast(bytes);
  if (answer == kFailed) {
    throw Failed(bytes);
  }
  results.bytes = split(bytes);
  return results;
}

bool is_within_task() { return within_task(); }

void broadcast(std::string& bytes) {
  auto size = static_cast<std::uint64_t>(bytes.size());
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  bytes.resize(size);
  constexpr std::uint64_t kMost = 1U << 30U;  // a count is an int
  for (std::uint64_t at = 0; at < size; at += kMost) {
    MPI_Bcast(bytes.data() + at, static_cast<int>(std::min(kMost, size - at)), MPI_BYTE, 0, MPI_COMM_WORLD);
  }
}

std::string machine() {
  std::array<char, MPI_MAX_PROCESSOR_NAME> name{};
  int length = 0;
  MPI_Get_processor_name(name.data(), &length);
  return {name.data(), static_cast<std::size_t>(length)};
}

}  // namespace plumbline::work
