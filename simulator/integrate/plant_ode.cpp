#include "simulator/integrate/plant_ode.h"

#include <sstream>

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

void PlantOde::reach(const double* x, double* reach) {
  const Eigen::Index n = plant_.positions();
  Ode::reach(x, reach);
  Eigen::Map<Eigen::VectorXd>(reach, n) = Eigen::Map<const Eigen::VectorXd>(x, n).cwiseAbs();
  plant_.raise_speeds(x, reach + n);
}

std::string PlantOde::state_name(int state) const {
  const std::vector<std::string> names = plant_.state_names();
  const auto i = static_cast<std::size_t>(state);
  return i < names.size() ? names[i] : i == names.size() ? "work" : "dissipated energy";
}

std::string PlantOde::stiffest(double /*t*/, const double* x) {
  const model::Stiffest found = plant_.stiffest(x, command_.data());
  std::ostringstream text;
  text.precision(2);
  if (!found.element.empty()) {
    text << found.element << " (alone it is as fast as " << found.rate << " 1/s)";
  }
  return text.str();
}

void PlantOde::switches(double /*t*/, const double* x, double* g) { plant_.switches(x, g); }

}  // namespace plumbline::integrate
