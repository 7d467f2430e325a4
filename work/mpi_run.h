// One run of tasks on the ranks of an MPI job: the first rank leads, the others follow.
#pragma once

#include <chrono>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "work/workers.h"

namespace plumbline::work {

/// Open MPI's own waits keep a core busy, which other ranks may need.
class Pause {
 public:
  void wait() {
    constexpr int kSpins = 20;
    constexpr std::chrono::microseconds kSleep(200);
    ++count_ < kSpins ? std::this_thread::yield() : std::this_thread::sleep_for(kSleep);
  }
  void reset() { count_ = 0; }

 private:
  int count_ = 0;
};

/// One line for each task: when it was given away and when its result was back (s since the start), and how
/// long the task itself took.
class Times {
 public:
  explicit Times(const std::string& file) : begin_(std::chrono::steady_clock::now()) {
    if (!file.empty()) {
      out_.open(file);
      out_ << "run,task,rank,given,back,seconds,processor\n";
    }
  }
  double now() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }
  void next_run() { ++run_; }
  void add(const std::string& task, int rank, double given, double seconds, double processor) {
    if (out_.is_open()) {
      out_ << run_ << ',' << task << ',' << rank << ',' << given << ',' << now() << ',' << seconds << ','
           << processor << std::endl;
    }
  }
  void end() {
    if (out_.is_open()) {
      out_ << ",all,," << 0.0 << ',' << now() << ',' << now() << ',' << std::endl;
    }
  }

 private:
  std::chrono::steady_clock::time_point begin_;
  std::ofstream out_;
  int run_ = 0;
};

/// Messages to the first rank that say why another one cannot go on have this tag.
constexpr int kFailure = 3;

/// Hands out the tasks, and does some on a second thread.
Results lead(const std::vector<Task>& tasks, const Watch& watch, int ranks, Times& times);
/// The same call on every other rank.
Results follow(const std::vector<Task>& tasks, const Watch& watch);

/// Is this thread within a task? Whatever that asks for is done where it is.
bool is_within_task();

/// From the first rank to all.
void broadcast(std::string& bytes);

/// The name of this machine.
std::string machine();

}  // namespace plumbline::work
