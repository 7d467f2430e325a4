#include "tests/benchmark/timed_rows.h"

#include <algorithm>
#include <cstdio>
#include <exception>

namespace plumbline::benchmarks {
namespace {

constexpr double kLost = 1.0;  // an error as large as the motion itself

void run_all(TimedRow& row, const std::vector<Judged>& motions, model::Plant& plant) {
  double seconds = 0.0;
  row.steps = 0;
  row.rate_evaluations = 0;
  for (const Judged& motion : motions) {
    const Course course = row.run(motion.replay);
    seconds += course.seconds;
    row.steps += course.summary.steps;
    row.rate_evaluations += course.summary.rate_evaluations;
    const double error = trajectory_error(course, motion.reference, plant);
    row.error = error <= row.error ? row.error : error;  // no number is the worst
  }
  row.seconds = row.seconds == 0.0 ? seconds : std::min(row.seconds, seconds);
}

}  // namespace

double simulated_seconds(const std::vector<Judged>& motions) {
  double sum = 0.0;
  for (const Judged& motion : motions) sum += motion.replay.seconds();
  return sum;
}

void run_in_turn(std::vector<TimedRow>& rows, const std::vector<Judged>& motions, model::Plant& plant,
                 int rounds) {
  for (int round = 0; round < rounds; ++round) {
    for (TimedRow& row : rows) {
      if (!row.failure.empty()) {
        continue;
      }
      try {
        run_all(row, motions, plant);
      } catch (const std::exception& error) {
        row.failure = error.what();
      }
    }
  }
}

void print_head() {
  std::printf("%-20s %9s %10s %10s %8s %9s %9s\n", "method", "tol, step", "error", "s/s", "x real", "steps/s",
              "rates/s");
}

void print(const TimedRow& row, double simulated) {
  std::printf("%-20s %9.2e ", row.method.c_str(), row.setting);
  if (!row.failure.empty()) {
    std::printf("%s\n", row.failure.c_str());
    return;
  }
  const auto per_second = [&](long count) { return static_cast<double>(count) / simulated; };
  std::printf("%10.2e %10.6f %8.1f %9.0f %9.0f%s\n", row.error, row.seconds / simulated,
              simulated / row.seconds, per_second(row.steps), per_second(row.rate_evaluations),
              row.error < kLost ? "" : "  unstable");
}

const TimedRow* quickest(const std::vector<TimedRow>& rows, bool peer, double error) {
  const TimedRow* best = nullptr;
  for (const TimedRow& row : rows) {
    const bool good = row.peer == peer && row.failure.empty() && row.error <= error;
    if (good && (best == nullptr || row.seconds < best->seconds)) {
      best = &row;
    }
  }
  return best;
}

}  // namespace plumbline::benchmarks
