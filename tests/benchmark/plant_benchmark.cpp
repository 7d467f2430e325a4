// What a simulated second of the leg bench costs, method by method at the same accuracy, and what one
// evaluation costs beside MuJoCo's.
//
// times_real_time: simulated over processor time (aim: 20). accuracy: of the end state, against a reference
// at 1e-10, relative, the worse of positions and velocities. rtol: the loosest tolerance found to reach 1e-6.
#include <benchmark/benchmark.h>

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <vector>

#include "simulator/integrate/plant_ode.h"
#include "tests/limits/bench.h"
#include "tests/oracles/leg_bench_lagrangian.h"
#ifdef PLUMBLINE_HAS_MUJOCO
#include "tests/benchmark/mujoco_leg.h"
#endif

namespace plumbline::benchmarks {
namespace {

using integrate::Method;

constexpr double kSeconds = 1.0;
constexpr double kAccuracy = 1e-6;
constexpr double kReferenceStep = 1e-4;  // s, so that the reference shares no steps with what it judges

/// One second of both motors, driven through the integrator itself, so that history can be kept or not.
class Second {
 public:
  explicit Second(const model::Model& model)
      : plant_(model, {}), ode_(plant_, false, false), experiment_(limits::both_motors(model, kSeconds)) {
    x0_ = validation::start_state(plant_, experiment_);
  }

  integrate::Summary run(Method method, bool keep_history, double rtol, double max_step = 0.0) {
    integrate::Options options;
    options.method = method;
    options.relative_tolerance = rtol;
    options.max_step = max_step;
    options.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-2 * rtol);
    integrate::Integrator integrator(ode_, options);
    integrator.start(0.0, x0_);
    const Eigen::Index samples = experiment_.time.size() - 1;
    for (Eigen::Index k = 0; k < samples; ++k) {
      for (std::size_t m = 0; m < experiment_.commands.size(); ++m) {
        ode_.command()[m] = experiment_.commands[m].values[k];  // mimo.yaml names them in the model's order
      }
      integrator.input_changed(keep_history);
      integrator.advance(experiment_.period * static_cast<double>(k + 1));
    }
    end_ = integrator.state();
    return integrator.summary();
  }

  const Eigen::VectorXd& end() const { return end_; }
  int positions() const { return plant_.positions(); }

 private:
  model::Plant plant_;
  integrate::PlantOde ode_;
  validation::Experiment experiment_;
  Eigen::VectorXd x0_, end_;
};

double difference(const Second& second, const Eigen::VectorXd& reference) {
  const Eigen::Index n = second.positions();
  const Eigen::VectorXd error = second.end() - reference;
  return std::max(error.head(n).norm() / reference.head(n).norm(),
                  error.segment(n, n).norm() / reference.segment(n, n).norm());
}

/// The loosest tolerance, in factors of the square root of ten, from which the accuracy is reached.
double sufficient_tolerance(Second& second, Method method, bool keep_history,
                            const Eigen::VectorXd& reference) {
  constexpr int kFactors = 18;  // from 1e-3 down to 1e-12
  for (int i = 0; i < kFactors; ++i) {
    const double rtol = 1e-3 * std::pow(10.0, -0.5 * i);
    try {
      second.run(method, keep_history, rtol);
    } catch (const std::runtime_error&) {
      continue;
    }
    if (difference(second, reference) < kAccuracy) {
      return rtol;
    }
  }
  return 0.0;
}

model::Model stretched() {
  model::Model model = limits::leg_bench();
  model = limits::with_effect(model, "cable_stretch", "leg_angle", {50.0, 0.1});
  model = limits::with_effect(model, "cable_stretch", "leg_shape", {100.0, 0.2});
  return limits::with_effect(model, "lugre", "mLS", {0.05, 0.02, 1.0, 5.0, 0.05, 0.0});
}

void simulated_second(benchmark::State& state, model::Model (*model)(), Method method, bool keep_history) {
  Second second(model());
  second.run(Method::explicit_rk, true, 1e-10, kReferenceStep);
  const Eigen::VectorXd reference = second.end();
  const double rtol = sufficient_tolerance(second, method, keep_history, reference);
  if (rtol == 0.0) {
    state.SkipWithError("does not reach 1e-6");
    return;
  }
  integrate::Summary summary;
  for (auto _ : state) {
    summary = second.run(method, keep_history, rtol);
  }
  state.counters["rtol"] = rtol;
  state.counters["accuracy"] = difference(second, reference);
  state.counters["rates_per_s"] = static_cast<double>(summary.rate_evaluations) / kSeconds;
  state.counters["jacobians_per_s"] = static_cast<double>(summary.jacobian_evaluations) / kSeconds;
  state.counters["times_real_time"] =
      benchmark::Counter(kSeconds, benchmark::Counter::kIsIterationInvariantRate);
}

void register_seconds() {
  struct Way {
    const char* name;
    Method method;
    bool keep_history;
  };
  for (const auto& [name, model] :
       {std::pair("rigid", &limits::leg_bench), std::pair("stretched", &stretched)}) {
    for (const Way& way :
         {Way{"explicit_rk", Method::explicit_rk, true}, Way{"implicit_rk", Method::implicit_rk, true},
          Way{"bdf_restarted", Method::bdf, false}, Way{"bdf_history", Method::bdf, true}}) {
      benchmark::RegisterBenchmark((std::string(name) + "/" + way.name).c_str(), simulated_second, model,
                                   way.method, way.keep_history)
          ->Unit(benchmark::kMillisecond);
    }
  }
}

struct Probe {
  Eigen::Vector2d q, v, torques;  // of hip and knee
};

std::vector<Probe> probes() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  std::vector<Probe> all(64);
  for (Probe& probe : all) {
    probe.q = {draw(random), draw(random)};
    probe.v = {5.0 * draw(random), 5.0 * draw(random)};
    probe.torques = {10.0 * draw(random), 10.0 * draw(random)};
  }
  return all;
}

void one_plant_rate(benchmark::State& state) {
  model::Plant plant(limits::leg_bench(), {});
  Eigen::Vector4d x, xdot;
  const std::vector<Probe> all = probes();
  std::size_t i = 0;
  for (auto _ : state) {
    x << all[i % 64].q, all[i % 64].v;
    plant.rate(x.data(), all[i % 64].torques.data(), xdot.data());
    benchmark::DoNotOptimize(xdot.data());
    ++i;
  }
}

#ifdef PLUMBLINE_HAS_MUJOCO
/// The peer must compute the same physics, as far as it has it: by the closed form of the two links.
double peer_error(MujocoLeg& peer) {
  oracles::LegBenchConstants leg = oracles::mabel_left_leg();
  leg.leg_angle = {};
  leg.cshin = {};
  leg.cspring = {0.0, 0.0, 0.0, leg.cspring.inertia};
  Eigen::Matrix2d to_links;  // (thigh, shin) from (hip, knee)
  to_links << 1.0, 0.0, 1.0, 1.0;
  double worst = 0.0;
  for (const Probe& probe : probes()) {
    const Eigen::Vector2d force = to_links.transpose().inverse() * probe.torques;
    const Eigen::Vector2d bias = oracles::leg_bench_bias(leg, to_links * probe.q, to_links * probe.v);
    const Eigen::Matrix2d M = oracles::leg_bench_mass_matrix(leg, to_links * probe.q);
    const Eigen::Vector2d expected = to_links.inverse() * M.inverse() * (force - bias);
    worst = std::max(
        worst, (peer.accelerations(probe.q, probe.v, probe.torques) - expected).norm() / expected.norm());
  }
  return worst;
}

double seconds_of(const std::function<void(const Probe&)>& evaluate, const std::vector<Probe>& all) {
  const auto start = std::chrono::steady_clock::now();
  for (int repeat = 0; repeat < 20; ++repeat) {
    for (const Probe& probe : all) {
      evaluate(probe);
    }
  }
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  return taken.count() / (20.0 * static_cast<double>(all.size()));
}

/// Both in turn, so that whatever else the machine does falls on both.
void rate_against_mujoco(benchmark::State& state) {
  model::Plant plant(limits::leg_bench(), {});
  MujocoLeg peer;
  const double error = peer_error(peer);
  if (!(error < 1e-9)) {
    state.SkipWithError("the peer's accelerations differ from the closed form");
    return;
  }
  const std::vector<Probe> all = probes();
  Eigen::Vector4d x, xdot;
  const auto ours = [&](const Probe& probe) {
    x << probe.q, probe.v;
    plant.rate(x.data(), probe.torques.data(), xdot.data());
    benchmark::DoNotOptimize(xdot.data());
  };
  const auto theirs = [&](const Probe& probe) {
    benchmark::DoNotOptimize(peer.accelerations(probe.q, probe.v, probe.torques));
  };
  double our_best = 1.0;
  double their_best = 1.0;
  for (auto _ : state) {
    our_best = std::min(our_best, seconds_of(ours, all));
    their_best = std::min(their_best, seconds_of(theirs, all));
  }
  state.counters["plant_us"] = 1e6 * our_best;
  state.counters["mujoco_us"] = 1e6 * their_best;
  state.counters["plant_over_mujoco"] = our_best / their_best;
  state.counters["peer_error"] = error;
}
#endif

void register_evaluations() {
  benchmark::RegisterBenchmark("plant_rate", one_plant_rate)->Unit(benchmark::kMicrosecond);
#ifdef PLUMBLINE_HAS_MUJOCO
  benchmark::RegisterBenchmark("rate_against_mujoco", rate_against_mujoco)->Unit(benchmark::kMillisecond);
#else
  std::printf("MuJoCo is not installed: no comparison with it\n");
#endif
}

}  // namespace
}  // namespace plumbline::benchmarks

int main(int argc, char** argv) {
  plumbline::benchmarks::register_seconds();
  plumbline::benchmarks::register_evaluations();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
