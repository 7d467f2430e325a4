// SUNDIALS behind one small door: an Ode goes in, an Integrator advances it, a Summary comes out.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace plumbline::integrate {

/// x' = f(t, x), with optional approximate Jacobian, switching functions and constraint projection.
/// Not thread-safe: one object for each thread.
class Ode {
 public:
  virtual ~Ode() = default;
  virtual int size() const = 0;
  virtual void rate(double t, const double* x, double* xdot) = 0;

  /// May be approximate: only the speed of the implicit methods depends on it. Row-major false:
  /// J(i,j)=df_i/dx_j.
  virtual bool has_jacobian() const { return false; }
  virtual void jacobian(double t, const double* x, Eigen::Ref<Eigen::MatrixXd> J);

  /// The rates of the first positions() states are the states behind them: x_i' = x_(positions + i). Linearly
  /// implicit methods then solve for the others only. 0: not known.
  virtual int positions() const { return 0; }

  /// What the relative tolerance of each state is relative to under Weight::reach: raised to what x shows.
  /// Here: the largest magnitude so far.
  virtual void reach(const double* x, double* reach);

  /// For the message of an integrator that gives up: a state's name, and where the fastest rate at x comes
  /// from.
  virtual std::string state_name(int state) const;
  virtual std::string stiffest(double t, const double* x);

  /// Switching functions; the integrator stops at their zeros.
  virtual int switch_count() const { return 0; }
  virtual void switches(double t, const double* x, double* g);

  /// Moves x onto the constraint manifold; returns the constraint's norm before the move.
  virtual bool has_projection() const { return false; }
  virtual double project(double t, double* x);
};

/// CVODE; ARKODE, diagonally implicit; ARKODE, explicit; linearly implicit with an approximate Jacobian.
enum class Method { bdf, implicit_rk, explicit_rk, rosenbrock };
std::string to_string(Method method);

/// What a state's relative tolerance is relative to: its present magnitude, or the reach that the Ode states.
/// The present magnitude asks for absolute accuracy of whatever passes through zero.
enum class Weight { present, reach };

struct Options {
  Method method = Method::explicit_rk;
  int order = 0;  ///< 0: the method's default (bdf 5, implicit 4, explicit 5, rosenbrock 3)
  double relative_tolerance = 1e-6;
  Eigen::VectorXd absolute_tolerance;  ///< one for each state, or one value for all; empty: 1e-9
  Weight weight = Weight::present;
  double max_step = 0.0;    ///< 0: none
  double fixed_step = 0.0;  ///< > 0: no error control (RK methods only; order tests)
  long max_steps = 200000;  ///< between two stops
  /// `relative`, and a hundredth of it absolute for every state.
  void set_tolerance(double relative);
  void validate() const;  ///< throws std::invalid_argument naming the option, its value and the allowed range
};

struct Summary {
  std::string method;
  long steps = 0, error_test_failures = 0, rate_evaluations = 0, jacobian_evaluations = 0, restarts = 0;
  long switches_found = 0;
  double largest_projection = 0.0;  ///< constraint norm before projection
};

struct Event {
  double time = 0.0;
  int index = 0;            ///< which switching function
  int direction = 0;        ///< +1 rising, -1 falling
  Eigen::VectorXd state{};  ///< just behind the zero
};

class Integrator {
 public:
  Integrator(Ode& ode, const Options& options);
  ~Integrator();
  Integrator(const Integrator&) = delete;
  Integrator& operator=(const Integrator&) = delete;

  /// Begin (again) at t with state x; forgets history, events and counts.
  void start(double t, const Eigen::VectorXd& x);
  /// The right-hand side has jumped (a new held command). `keep_history`: bdf goes on with its old history
  /// (cheap; right when the jump is small), otherwise restarts. One-step methods need no restart.
  void input_changed(bool keep_history);
  /// Advance exactly to t_end; switching functions are located on the way, recorded, and the method restarted
  /// behind each. Throws std::runtime_error on failure: method, time, reason, the state with the largest
  /// local error and the Ode's stiffest element. What the Ode throws passes through. After either, start
  /// again.
  void advance(double t_end);
  /// The same, but of one step of the method at most: t_end need not be reached.
  void step(double t_end);

  double time() const;
  const Eigen::VectorXd& state() const;
  const std::vector<Event>& events() const;
  Summary summary() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace plumbline::integrate
