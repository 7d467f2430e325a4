// Rows of a table of accuracy against time: every row simulates the same motions, in turn with the others.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/benchmark/replay.h"

namespace plumbline::benchmarks {

struct TimedRow {
  std::string method;
  double setting = 0.0;  ///< tolerance, or step in s
  bool peer = false;     ///< another simulator's
  std::function<Course(const Replay&)> run;

  double seconds = 0.0;  ///< of processor time for all motions, the least of all rounds
  double error = 0.0;    ///< trajectory_error, the largest of all motions
  long steps = 0, rate_evaluations = 0;
  std::string failure{};
};

/// A motion and the course that it should take.
struct Judged {
  Replay replay;
  Course reference;
};

double simulated_seconds(const std::vector<Judged>& motions);

/// Runs every row once in each round, so that whatever else the machine does falls on all of them. A row that
/// throws is not run again.
void run_in_turn(std::vector<TimedRow>& rows, const std::vector<Judged>& motions, model::Plant& plant,
                 int rounds);

void print_head();
void print(const TimedRow& row, double simulated);

/// The quickest row of ours (or of the peer) with at most this error; nullptr: none.
const TimedRow* quickest(const std::vector<TimedRow>& rows, bool peer, double error);

}  // namespace plumbline::benchmarks
