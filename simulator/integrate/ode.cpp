#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "simulator/integrate/integrator.h"

namespace plumbline::integrate {

// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void Ode::jacobian(double /*t*/, const double* /*x*/, Eigen::Ref<Eigen::MatrixXd> /*J*/) {
  throw std::logic_error("Ode::jacobian: has_jacobian() is true, but jacobian() is not overridden");
}

void Ode::reach(const double* x, double* reach) {
  for (int i = 0; i < size(); ++i) {
    reach[i] = std::max(reach[i], std::abs(x[i]));
  }
}

std::string Ode::state_name(int state) const { return "state " + std::to_string(state + 1); }

std::string Ode::stiffest(double /*t*/, const double* /*x*/) { return ""; }

void Ode::switches(double /*t*/, const double* /*x*/, double* /*g*/) {
  throw std::logic_error("Ode::switches: switch_count() is positive, but switches() is not overridden");
}

double Ode::project(double /*t*/, double* /*x*/) {
  throw std::logic_error("Ode::project: has_projection() is true, but project() is not overridden");
}

}  // namespace plumbline::integrate
