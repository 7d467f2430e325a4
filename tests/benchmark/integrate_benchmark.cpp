// What the methods cost when the input is held over samples of 1 ms, as in every simulation of a sampled
// robot.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

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

/// A command like that of a controller: smooth, sampled at 1 kHz.
double command(int sample) { return 20.0 * std::sin(0.02 * sample) + 5.0 * std::sin(0.31 * sample); }

template <class System>
void run_held(benchmark::State& state, System& system, const Options& options, bool keep_history) {
  constexpr int samples = 1000;
  constexpr double period = 1e-3;
  Integrator integrator(system, options);
  Summary summary;
  for (auto _ : state) {
    integrator.start(0.0, Eigen::VectorXd::Zero(system.size()));
    for (int k = 0; k < samples; ++k) {
      system.force = command(k);
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

void two_masses(benchmark::State& state, double stiffness, double damping, Method method, bool keep_history) {
  TwoMasses system(stiffness, damping);
  run_held(state, system, with(method), keep_history);
}

void trivial(benchmark::State& state, Method method, bool keep_history) {
  TwoOscillators system;
  run_held(state, system, with(method), keep_history);
}

struct Case {
  std::string name;
  Method method;
  bool keep_history;
};

void register_all() {
  const Case cases[] = {{"bdf/restarted", Method::bdf, false},
                        {"bdf/history", Method::bdf, true},
                        {"implicit_rk", Method::implicit_rk, true},
                        {"explicit_rk", Method::explicit_rk, true}};
  for (const Case& c : cases) {
    const auto register_one = [&c](const std::string& system, auto run) {
      benchmark::RegisterBenchmark((system + "/" + c.name).c_str(), run)->Unit(benchmark::kMillisecond);
    };
    register_one("trivial", [c](benchmark::State& s) { trivial(s, c.method, c.keep_history); });
    // 160 Hz lightly damped; 5 kHz; overdamped, 2e4/s.
    register_one("soft", [c](benchmark::State& s) { two_masses(s, 1e4, 5.0, c.method, c.keep_history); });
    register_one("stiff", [c](benchmark::State& s) { two_masses(s, 1e7, 100.0, c.method, c.keep_history); });
    register_one("overdamped",
                 [c](benchmark::State& s) { two_masses(s, 1e5, 2000.0, c.method, c.keep_history); });
  }
}

}  // namespace
}  // namespace plumbline::integrate

int main(int argc, char** argv) {
  plumbline::integrate::register_all();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
