// How exactly and how fast one hop of the whole machine is simulated, method by method, in one run on one
// core. The torques are those of a controller's run, recorded and held; the controller itself is not in the
// loop.
//
// error, worst: tests/benchmark/replay.h. Both are against implicit_rk at the tightest tolerance;
// rosenbrock at a tight one, shown below it, says how far to trust it. x real: simulated time over processor
// time (aim: 10).
#include <cstdio>
#include <exception>
#include <functional>
#include <string>

#include "tests/benchmark/recorded_hop.h"
#include "tests/benchmark/simbody_peer.h"

namespace plumbline::benchmarks {
namespace {

using integrate::Method;
using integrate::Weight;

constexpr double kReference = 1e-10;
constexpr double kCheck = 1e-9;     // of an order 3 method: 40000 steps
constexpr double kPatience = 30.0;  // s

integrate::Options with(Method method, double tolerance, Weight weight = Weight::reach) {
  integrate::Options options;
  options.method = method;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-2 * tolerance);
  options.weight = weight;
  options.max_steps = 100000;
  return options;
}

class Table {
 public:
  explicit Table(const std::string& model_file) : hop_(record_hop(model_file)), plant_(hop_.model, {}) {
    std::printf("\n%s: a hop of %.3f s, %d states\n", model_file.c_str(), hop_.seconds(), plant_.states());
    std::printf("%-20s %9s %10s %10s %10s %8s %8s %9s %9s %7s\n", "method", "tolerance", "error", "worst",
                "s/s", "x real", "steps/s", "rates/s", "jacob./s", "failed");
    reference_ = simulate(hop_, plant_, with(Method::implicit_rk, kReference, Weight::present));
    row("(reference)", kReference, [&]() { return reference_; });
  }

  void ours(Method method, double tolerance, Weight weight = Weight::reach) {
    const std::string name = to_string(method) + (weight == Weight::present ? ", present" : "");
    row(name, tolerance, [&]() { return simulate(hop_, plant_, with(method, tolerance, weight)); });
  }

  void simbodys(Peer peer, double tolerance) {
    row(to_string(peer), tolerance,
        [&]() { return simulate(hop_, plant_, peer, tolerance, reference_, kPatience); });
  }

 private:
  void row(const std::string& name, double tolerance, const std::function<Course()>& run) {
    std::printf("%-20s %9.1e ", name.c_str(), tolerance);
    try {
      const Course course = run();
      const double simulated = hop_.seconds();
      const auto per_second = [&](long count) { return static_cast<double>(count) / simulated; };
      std::printf("%10.2e %10.2e %10.4f %8.1f %8.0f %9.0f %9.0f %7.0f\n",
                  trajectory_error(course, reference_, plant_), worst_coordinate(course, reference_, plant_),
                  course.seconds / simulated, simulated / course.seconds, per_second(course.summary.steps),
                  per_second(course.summary.rate_evaluations),
                  per_second(course.summary.jacobian_evaluations),
                  per_second(course.summary.error_test_failures));
    } catch (const std::exception& error) {
      std::printf("%s\n", error.what());
    }
    std::fflush(stdout);
  }

  Replay hop_;
  model::Plant plant_;
  Course reference_;
};

void compare(const std::string& model_file, bool quick) {
  Table table(model_file);
  table.ours(Method::rosenbrock, kCheck, Weight::present);
  for (const double tolerance : {1e-3, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 1e-7}) {
    table.ours(Method::rosenbrock, tolerance);
  }
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) {
    table.ours(Method::rosenbrock, tolerance, Weight::present);
  }
  if (quick) return;
  for (const Method method : {Method::implicit_rk, Method::bdf}) {
    for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7}) table.ours(method, tolerance);
    for (const double tolerance : {1e-5, 1e-6}) table.ours(method, tolerance, Weight::present);
  }
  for (const double tolerance : {1e-4, 1e-6}) table.ours(Method::explicit_rk, tolerance);
  for (const double tolerance : {1e-3, 1e-5}) table.simbodys(Peer::runge_kutta_merson, tolerance);
  for (const double tolerance : {1e-4, 1e-5, 1e-6}) table.simbodys(Peer::cpodes_bdf, tolerance);
}

}  // namespace
}  // namespace plumbline::benchmarks

// quick: our own method only.
int main(int argc, char** argv) {
  const bool quick = argc > 1 && std::string(argv[1]) == "quick";
  plumbline::benchmarks::compare("mabel_planar.yaml", quick);
  plumbline::benchmarks::compare("mabel.yaml", quick);
  return 0;
}
