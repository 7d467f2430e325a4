#include "simulator/integrate/plant_ode.h"

namespace plumbline::integrate {

PlantOde::PlantOde(model::Plant& plant, bool with_energy, bool with_switches)
    : plant_(plant),
      with_energy_(with_energy),
      with_switches_(with_switches),
      command_(Eigen::VectorXd::Zero(plant.motors())) {}

int PlantOde::size() const { return plant_.states() + (with_energy_ ? 2 : 0); }

void PlantOde::rate(double /*t*/, const double* x, double* xdot) {
  plant_.rate(x, command_.data(), xdot);
  if (with_energy_) {
    const model::Energetics e = plant_.powers(x);
    xdot[plant_.states()] = e.input;
    xdot[plant_.states() + 1] = e.dissipated;
  }
}

void PlantOde::jacobian(double /*t*/, const double* x, Eigen::Ref<Eigen::MatrixXd> J) {
  J.setZero();
  plant_.stiff_jacobian(x, command_.data(), J.topLeftCorner(plant_.states(), plant_.states()));
}

void PlantOde::switches(double /*t*/, const double* x, double* g) { plant_.switches(x, g); }

}  // namespace plumbline::integrate
