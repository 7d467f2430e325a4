// How exactly and how fast one leg is simulated that falls to the ground, compresses, leaves it once more and
// stands there: our methods beside MuJoCo's, in one run on one core. Both have the same links, joints,
// springs and dampers, and the same code of the ground's laws (contact/): before anything is timed, their
// accelerations must agree.
//
// The leg is dropped from several heights a little apart: where a step happens to meet the landing decides
// over the error of a single drop.
//
// error: the largest of the drops, tests/benchmark/replay.h, against implicit_rk at the tightest tolerance;
// rosenbrock at a tight one, shown first, says how far to trust it. s/s: processor time of a simulated
// second, the least of several rounds; x real: its reciprocal. rates/s: evaluations of the accelerations in a
// simulated second. Every kSample seconds the state is kept: our methods stop there, as MuJoCo's steps do.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <random>
#include <stdexcept>
#include <vector>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/benchmark/timed_rows.h"
#ifdef PLUMBLINE_HAS_MUJOCO
#include "tests/benchmark/mujoco_drop.h"
#endif

namespace plumbline::benchmarks {
namespace {

using integrate::Method;
using integrate::Weight;

constexpr double kSample = 2e-3;   // s, MuJoCo's usual step
constexpr double kSeconds = 0.8;   // s
constexpr double kHeight = 0.08;   // m, of the toe
constexpr double kApart = 0.0007;  // m, from one drop to the next: half a millisecond of the fall
constexpr double kSpeed = 0.2;     // m/s, forward
constexpr int kDrops = 5;
constexpr double kReference = 1e-10;
constexpr double kCheck = 1e-9;
constexpr int kRounds = 5;

model::Model leg() {
  return model::read_model(PLUMBLINE_ROOT "/tests/robots/leg/model.yaml", model::known_effects());
}

/// At the springs' rest, the toe above the ground at x = 0.
Replay drop(model::Plant& plant, double height) {
  Replay drop;
  drop.model = plant.model();
  drop.period = kSample;
  drop.commands.resize(0, std::lround(kSeconds / kSample));
  drop.start = Eigen::VectorXd::Zero(plant.states());
  const double bend = std::acos(-1.0) / 9.0;
  drop.start.segment(2, 2) << bend, -2.0 * bend;
  drop.start[1] = height + plant.foot_depth(0, drop.start.data()).depth;
  drop.start[plant.positions()] = kSpeed;
  return drop;
}

integrate::Options with(Method method, double tolerance, Weight weight) {
  integrate::Options options;
  options.method = method;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-2 * tolerance);
  options.weight = weight;
  return options;
}

std::vector<Judged> drops(model::Plant& plant) {
  std::vector<Judged> all;
  for (int i = 0; i < kDrops; ++i) {
    Replay one = drop(plant, kHeight + kApart * i);
    Course reference = simulate(one, plant, with(Method::implicit_rk, kReference, Weight::present));
    all.push_back({std::move(one), std::move(reference)});
  }
  return all;
}

TimedRow ours(model::Plant& plant, Method method, double tolerance, Weight weight = Weight::reach) {
  const std::string name = to_string(method) + (weight == Weight::present ? ", present" : "");
  const integrate::Options options = with(method, tolerance, weight);
  return {name, tolerance, false,
          [&plant, options](const Replay& drop) { return simulate(drop, plant, options); }};
}

std::vector<TimedRow> our_rows(model::Plant& plant) {
  std::vector<TimedRow> rows;
  for (const double tolerance : {1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7}) {
    rows.push_back(ours(plant, Method::rosenbrock, tolerance));
  }
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    rows.push_back(ours(plant, Method::rosenbrock, tolerance, Weight::present));
  }
  for (const Method method : {Method::implicit_rk, Method::bdf, Method::explicit_rk}) {
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
      rows.push_back(ours(plant, method, tolerance));
    }
  }
  return rows;
}

void describe(const Judged& drop, model::Plant& plant) {
  double deepest = 0.0;
  int inside = 0;
  int landings = 0;
  bool before = false;
  for (Eigen::Index k = 0; k < drop.reference.states.cols(); ++k) {
    const double depth = plant.foot_depth(0, drop.reference.states.col(k).data()).depth;
    deepest = std::max(deepest, depth);
    inside += depth > 0.0 ? 1 : 0;
    landings += depth > 0.0 && !before ? 1 : 0;
    before = depth > 0.0;
  }
  std::printf(
      "%d drops of %.3f s from %.3f m and a little more at %.1f m/s; the first: %d landings, %.3f s in "
      "the ground, at most %.2f mm\n",
      kDrops, kSeconds, kHeight, kSpeed, landings, inside * kSample, 1e3 * deepest);
}

#ifdef PLUMBLINE_HAS_MUJOCO
constexpr double kSame = 1e-9;

/// Largest difference of the rates at random states in the air and in the ground, relative to their size.
double disagreement(MujocoDrop& peer, const Eigen::VectorXd& start, model::Plant& plant) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  double worst = 0.0;
  for (int probe = 0; probe < 1000; ++probe) {
    Eigen::VectorXd x = start;
    const Eigen::Index n = plant.positions();
    for (Eigen::Index i = 0; i < n; ++i) {
      x[i] += 0.5 * draw(random);
      x[n + i] = 3.0 * draw(random);
    }
    x[1] += plant.foot_depth(0, x.data()).depth + 5e-3 * draw(random);  // the toe within 5 mm of the surface
    x[2 * n] = 5e-3 * draw(random);
    Eigen::VectorXd ours(plant.states());
    plant.rate(x.data(), nullptr, ours.data());
    const Eigen::VectorXd difference = peer.rate(x) - ours;
    const double apart = std::max(difference.segment(n, n).norm() / ours.segment(n, n).norm(),
                                  difference.tail(2).norm() / ours.tail(2).norm());
    worst = apart <= worst ? worst : apart;  // no number is the worst
  }
  return worst;
}

void check(MujocoDrop& peer, const Eigen::VectorXd& start, model::Plant& plant) {
  const double apart = disagreement(peer, start, plant);
  std::printf("rates at random states: MuJoCo's differ from ours by %.1e at most\n", apart);
  if (!(apart < kSame)) {
    throw std::runtime_error("MuJoCo's accelerations differ from ours: not the same leg");
  }
}

void add_peer(std::vector<TimedRow>& rows, MujocoDrop& peer) {
  for (const MujocoMethod method : {MujocoMethod::runge_kutta, MujocoMethod::implicit, MujocoMethod::euler}) {
    for (const int steps : {1, 2, 4, 5, 8, 10, 16, 20, 40, 50, 80, 100, 200}) {
      rows.push_back({to_string(method), kSample / steps, true, [&peer, method, steps](const Replay& drop) {
                        return peer.simulate(drop, method, steps);
                      }});
    }
  }
}

void print_ratio(const std::vector<TimedRow>& rows, double error) {
  const TimedRow* our = quickest(rows, false, error);
  const TimedRow* their = quickest(rows, true, error);
  if (our == nullptr || their == nullptr) {
    std::printf("error at most %.0e: not reached by both\n", error);
    return;
  }
  std::printf("error at most %.0e: %s at %.0e takes %.2f of the time of %s at %.2e s\n", error,
              our->method.c_str(), our->setting, our->seconds / their->seconds, their->method.c_str(),
              their->setting);
}
#endif

void measure(std::vector<TimedRow>& rows, const std::vector<Judged>& drops, model::Plant& plant) {
  rows.insert(rows.begin(), ours(plant, Method::rosenbrock, kCheck, Weight::present));
  describe(drops.front(), plant);
  run_in_turn(rows, drops, plant, kRounds);
  print_head();
  for (const TimedRow& row : rows) print(row, simulated_seconds(drops));
}

void compare() {
  model::Plant plant(leg(), {});
  const std::vector<Judged> all = drops(plant);
  std::vector<TimedRow> rows = our_rows(plant);
#ifdef PLUMBLINE_HAS_MUJOCO
  MujocoDrop peer(plant.model());
  check(peer, all.front().replay.start, plant);
  add_peer(rows, peer);
  measure(rows, all, plant);
  for (const double error : {1e-3, 1e-4}) print_ratio(rows, error);
#else
  std::printf("MuJoCo is not installed: no comparison with it\n");
  measure(rows, all, plant);
#endif
}

}  // namespace
}  // namespace plumbline::benchmarks

int main() {
  try {
    plumbline::benchmarks::compare();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
