// One integration method, as the Integrator drives it.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "simulator/integrate/bridge.h"
#include "simulator/integrate/handles.h"
#include "simulator/integrate/integrator.h"

namespace plumbline::integrate {

struct Counts {
  long steps = 0, error_test_failures = 0, jacobian_evaluations = 0, restarts = 0;
};

class Backend {
 public:
  virtual ~Backend() = default;
  Backend(const Backend&) = delete;
  Backend& operator=(const Backend&) = delete;

  /// Begin at t with state x, as if new.
  virtual void start(double t, const Eigen::VectorXd& x) = 0;
  virtual void input_changed(bool keep_history) = 0;
  /// Integrate to t_stop, or to the first switch before it: true, with `directions` filled; the method has
  /// then begun anew behind the switch.
  virtual bool advance(double t_stop) = 0;
  /// The same, but of one step at most.
  virtual bool step_once(double t_stop) = 0;
  virtual Counts counts() const = 0;
  /// The state whose local error was largest, by its weight, in the last step tried; -1: none.
  virtual int worst_state() const = 0;

  [[noreturn]] void fail(const std::string& reason) {
    bridge_.fail(to_string(options_.method), t_, x_, reason + worst());
  }

  double time() const { return t_; }
  void set_time(double t) { t_ = t; }
  const Eigen::VectorXd& state() const { return x_; }
  /// For each switching function: +1 rose, -1 fell, 0 did neither.
  const std::vector<int>& directions() const { return directions_; }

 protected:
  Backend(Bridge& bridge, const Options& options)
      : bridge_(bridge),
        options_(options),
        x_(Eigen::VectorXd::Zero(bridge.ode().size())),
        directions_(static_cast<std::size_t>(bridge.ode().switch_count()), 0) {}

  /// " Largest local error: NAME.", or where there is no error yet, the state that changes fastest.
  std::string worst();
  /// Index of the largest |error| * weight, or of the first that is not finite; -1 when all are zero.
  static int largest(const Eigen::ArrayXd& weighed);
  /// The same of what a SUNDIALS integrator gives as local errors and their weights.
  using GetVector = int (*)(void* memory, N_Vector vector);
  int largest_estimate(void* memory, GetVector errors, GetVector weights, const Context& context) const;

  Bridge& bridge_;
  const Options options_;
  double t_ = 0.0;
  Eigen::VectorXd x_;
  std::vector<int> directions_;
};

/// options: valid, with one absolute tolerance for each state.
std::unique_ptr<Backend> make_cvode_backend(Bridge& bridge, const Options& options);
std::unique_ptr<Backend> make_arkode_backend(Bridge& bridge, const Options& options);
std::unique_ptr<Backend> make_rosenbrock_backend(Bridge& bridge, const Options& options);

}  // namespace plumbline::integrate
