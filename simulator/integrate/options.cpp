#include <cmath>
#include <sstream>
#include <stdexcept>

#include "simulator/integrate/integrator.h"

namespace plumbline::integrate {

namespace {

template <class Value>
[[noreturn]] void refuse(const std::string& option, const Value& found, const std::string& expected) {
  std::ostringstream text;
  text << "integrator option " << option << ": found " << found << ", expected " << expected;
  throw std::invalid_argument(text.str());
}

int lowest_order(Method method) { return method == Method::bdf ? 1 : method == Method::rosenbrock ? 3 : 2; }

void check_order(const Options& options) {
  const int highest = options.method == Method::rosenbrock ? 3 : 5;
  if (options.order == 0) return;
  if (options.order < lowest_order(options.method) || options.order > highest) {
    refuse("order", options.order,
           "0 (the default) or " + std::to_string(lowest_order(options.method)) + " to " +
               std::to_string(highest) + " for " + to_string(options.method));
  }
}

bool positive(double value) { return std::isfinite(value) && value > 0.0; }
bool zero_or_positive(double value) { return std::isfinite(value) && value >= 0.0; }

}  // namespace

std::string to_string(Method method) {
  switch (method) {
    case Method::bdf:
      return "bdf";
    case Method::implicit_rk:
      return "implicit_rk";
    case Method::explicit_rk:
      return "explicit_rk";
    case Method::rosenbrock:
      return "rosenbrock";
  }
  throw std::logic_error("to_string: no such integration method");
}

void Options::set_tolerance(double relative) {
  relative_tolerance = relative;
  absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-2 * relative);
}

void Options::validate() const {
  check_order(*this);
  if (!positive(relative_tolerance) || relative_tolerance >= 1.0) {
    refuse("relative_tolerance", relative_tolerance, "more than 0 and less than 1");
  }
  for (Eigen::Index i = 0; i < absolute_tolerance.size(); ++i) {
    if (!positive(absolute_tolerance[i])) {
      refuse("absolute_tolerance[" + std::to_string(i) + "]", absolute_tolerance[i], "a positive number");
    }
  }
  if (!zero_or_positive(max_step)) refuse("max_step", max_step, "0 (none) or a positive number of seconds");
  if (!zero_or_positive(fixed_step)) {
    refuse("fixed_step", fixed_step, "0 (error control) or a positive number of seconds");
  }
  if (fixed_step > 0.0 && method == Method::bdf) {
    refuse("fixed_step", fixed_step, "0 for bdf: only the Runge-Kutta methods can keep a fixed step");
  }
  if (max_steps < 1) refuse("max_steps", max_steps, "at least 1");
}

}  // namespace plumbline::integrate
