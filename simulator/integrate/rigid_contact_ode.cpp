#include "simulator/integrate/rigid_contact_ode.h"

#include <utility>

namespace plumbline::integrate {

RigidContactOde::RigidContactOde(model::Plant& plant, model::RigidContact& contact, Commands commands,
                                 int switch_count, Switches switches)
    : plant_(plant),
      contact_(contact),
      commands_(std::move(commands)),
      switch_count_(switch_count),
      switches_(std::move(switches)),
      command_(Eigen::VectorXd::Zero(plant.motors())) {}

void RigidContactOde::rate(double t, const double* x, double* xdot) {
  commands_(t, x, command_.data());
  contact_.rate(x, command_.data(), xdot);
  const model::Energetics powers = plant_.powers(x);
  xdot[plant_.states()] = powers.input;
  xdot[plant_.states() + 1] = powers.dissipated;
}

std::string RigidContactOde::state_name(int state) const {
  const int n = plant_.states();
  if (state >= n) {
    return state == n ? "work of the motors" : "dissipated energy";
  }
  return plant_.state_names()[static_cast<std::size_t>(state)];
}

double RigidContactOde::project(double /*t*/, double* x) { return contact_.project(x); }

}  // namespace plumbline::integrate
