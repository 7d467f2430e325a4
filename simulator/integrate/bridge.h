// What SUNDIALS calls back: an Ode behind C functions.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_matrix.h>
#include <sundials/sundials_types.h>

#include <Eigen/Core>
#include <exception>
#include <string>

#include "simulator/integrate/integrator.h"

namespace plumbline::integrate {

/// Counts the calls, keeps exceptions away from C, and collects SUNDIALS' messages instead of printing them.
class Bridge {
 public:
  Bridge(Ode& ode, Method method);

  /// The callbacks; `self` is a Bridge. They return 0, > 0 (try a smaller step) or < 0 (give up).
  static int rate(realtype t, N_Vector x, N_Vector xdot, void* self);
  static int jacobian(realtype t, N_Vector x, N_Vector xdot, SUNMatrix J, void* self, N_Vector, N_Vector,
                      N_Vector);
  static int switches(realtype t, N_Vector x, realtype* g, void* self);
  static int project_state(realtype t, N_Vector x, void* self);
  static int project_correction(realtype t, N_Vector x, N_Vector correction, realtype epsilon, N_Vector error,
                                void* self);
  /// The inverse of relative tolerance * reach + absolute tolerance, for Weight::reach.
  static int weights(N_Vector x, N_Vector weight, void* self);
  static void message(int code, const char* module, const char* function, char* text, void* self);

  Ode& ode() { return ode_; }
  /// xdot at (t, x), and the switching functions; for use outside of SUNDIALS.
  void rate_at(double t, const Eigen::VectorXd& x, Eigen::VectorXd& xdot);
  void switches_at(double t, const Eigen::VectorXd& x, Eigen::VectorXd& g) {
    ode_.switches(t, x.data(), g.data());
  }

  /// The right-hand side has changed: what is remembered no longer holds.
  void forget();
  /// As if new: also the counts.
  void reset();
  /// A failure of SUNDIALS in its own words.
  std::string reason(const std::string& flag) const;
  /// Throws what the Ode threw, or else std::runtime_error with method, time, reason and what is stiffest at
  /// x.
  [[noreturn]] void fail(const std::string& method, double t, const Eigen::VectorXd& x,
                         const std::string& reason);

  /// For weights().
  void set_tolerances(double relative, const Eigen::VectorXd& absolute) {
    relative_ = relative;
    absolute_ = absolute;
  }

  long rate_evaluations = 0;
  long jacobian_evaluations = 0;
  double largest_projection = 0.0;

 private:
  void evaluate(double t, const double* x, double* xdot);

  Ode& ode_;
  bool remember_rate_;  // answer a repeated question from memory: the Runge-Kutta methods ask twice at a
                        // restart
  int not_finite_code_;
  bool remembered_ = false;
  bool not_finite_ = false;
  double last_t_ = 0.0;
  Eigen::VectorXd last_x_, last_xdot_;
  double relative_ = 0.0;
  Eigen::VectorXd absolute_, reach_;
  std::exception_ptr thrown_;
  std::string message_;
};

}  // namespace plumbline::integrate
