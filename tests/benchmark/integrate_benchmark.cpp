// What the methods cost when the input is held over samples of 1 ms, as in every simulation of a sampled
// robot.
#include <benchmark/benchmark.h>

#include <cmath>

#include "simulator/integrate/integrator.h"

namespace plumbline::integrate {
namespace {

/// Two masses on springs and dampers, the first driven, the second behind a stiff stretch: a motor, its cable
/// and a leg. 4 states. Stiffness and damping of the stretch set how stiff the equations are.
class TwoMasses : public Ode {
 public:
  TwoMasses(double stiffness, double damping) : stiffness_(stiffness), damping_(damping) {}
  int size() const override { return 4; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    const double stretch = stiffness_ * (x[0] - x[1]) + damping_ * (x[2] - x[3]);
    xdot[0] = x[2];
    xdot[1] = x[3];
    xdot[2] = (force - stretch - 0.5 * x[2]) / 0.01;
    xdot[3] = stretch - 100.0 * std::sin(x[1]) - 0.2 * x[3];
  }
  bool has_jacobian() const override { return true; }
  void jacobian(double /*t*/, const double* x, Eigen::Ref<Eigen::MatrixXd> J) override {
    J.setZero();
    J(0, 2) = J(1, 3) = 1.0;
    J(2, 0) = -stiffness_ / 0.01;
    J(2, 1) = stiffness_ / 0.01;
    J(2, 2) = -(damping_ + 0.5) / 0.01;
    J(2, 3) = damping_ / 0.01;
    J(3, 0) = stiffness_;
    J(3, 1) = -stiffness_ - 100.0 * std::cos(x[1]);
    J(3, 2) = damping_;
    J(3, 3) = -damping_ - 0.2;
  }
  double force = 0.0;

 private:
  double stiffness_, damping_;
};

/// The simplest oscillators, to see what everything but the rate costs.
class TwoOscillators : public Ode {
 public:
  int size() const override { return 4; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    xdot[0] = x[1];
    xdot[1] = force - x[0];
    xdot[2] = x[3];
    xdot[3] = force - 4.0 * x[2];
  }
  double force = 0.0;
};

/// A command as of a controller, sampled at 1 kHz. rough: with a fast part, so that each sample is a large
/// jump.
double command(int sample, bool rough) {
  return 20.0 * std::sin(0.02 * sample) + (rough ? 5.0 * std::sin(0.31 * sample) : 0.0);
}

template <class System>
void run_held(benchmark::State& state, System& system, const Options& options, bool keep_history,
              bool rough) {
  constexpr int samples = 1000;
  constexpr double period = 1e-3;
  Integrator integrator(system, options);
  Summary summary;
  for (auto _ : state) {
    integrator.start(0.0, Eigen::VectorXd::Zero(system.size()));
    for (int k = 0; k < samples; ++k) {
      system.force = command(k, rough);
      integrator.input_changed(keep_history);
      integrator.advance(period * (k + 1));
    }
    summary = integrator.summary();
    benchmark::DoNotOptimize(integrator.state().data());
  }
  const double simulated = period * samples;
  state.counters["rates_per_s"] = static_cast<double>(summary.rate_evaluations) / simulated;
  state.counters["steps_per_s"] = static_cast<double>(summary.steps) / simulated;
  state.counters["failed_per_s"] = static_cast<double>(summary.error_test_failures) / simulated;
  state.counters["jacobians_per_s"] = static_cast<double>(summary.jacobian_evaluations) / simulated;
  state.counters["per_advance"] = benchmark::Counter(
      samples, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

Options with(Method method) {
  Options options;
  options.method = method;
  options.relative_tolerance = 1e-6;
  return options;
}

void two_oscillators(benchmark::State& state, Method method, bool keep_history) {
  TwoOscillators system;
  run_held(state, system, with(method), keep_history, true);
}

struct Stretch {
  double stiffness, damping;
  bool rough;
};
constexpr Stretch kSoft{1e4, 5.0, true};     // 160 Hz, lightly damped
constexpr Stretch kStiff{1e7, 100.0, true};  // 5 kHz
constexpr Stretch kStiffSmooth{1e7, 100.0, false};
constexpr Stretch kOverdamped{1e5, 2000.0, true};  // 2e5 1/s
constexpr Stretch kOverdampedSmooth{1e5, 2000.0, false};

void two_masses(benchmark::State& state, Stretch stretch, Method method, bool keep_history) {
  TwoMasses system(stretch.stiffness, stretch.damping);
  run_held(state, system, with(method), keep_history, stretch.rough);
}

BENCHMARK_CAPTURE(two_oscillators, bdf_restarted, Method::bdf, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_oscillators, bdf_history, Method::bdf, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_oscillators, implicit_rk, Method::implicit_rk, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_oscillators, explicit_rk, Method::explicit_rk, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, soft_bdf_restarted, kSoft, Method::bdf, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, soft_bdf_history, kSoft, Method::bdf, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, soft_implicit_rk, kSoft, Method::implicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, soft_explicit_rk, kSoft, Method::explicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_bdf_restarted, kStiff, Method::bdf, false)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_bdf_history, kStiff, Method::bdf, true)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_implicit_rk, kStiff, Method::implicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_explicit_rk, kStiff, Method::explicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_smooth_bdf_restarted, kStiffSmooth, Method::bdf, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_smooth_bdf_history, kStiffSmooth, Method::bdf, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_smooth_implicit_rk, kStiffSmooth, Method::implicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, stiff_smooth_explicit_rk, kStiffSmooth, Method::explicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_bdf_restarted, kOverdamped, Method::bdf, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_bdf_history, kOverdamped, Method::bdf, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_implicit_rk, kOverdamped, Method::implicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_explicit_rk, kOverdamped, Method::explicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_smooth_bdf_restarted, kOverdampedSmooth, Method::bdf, false)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_smooth_bdf_history, kOverdampedSmooth, Method::bdf, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_smooth_implicit_rk, kOverdampedSmooth, Method::implicit_rk, true)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(two_masses, overdamped_smooth_explicit_rk, kOverdampedSmooth, Method::explicit_rk, true)
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumbline::integrate

BENCHMARK_MAIN();
