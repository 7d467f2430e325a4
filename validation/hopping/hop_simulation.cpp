#include "validation/hopping/hop_simulation.h"

#include <algorithm>

namespace plumbline::validation {

HopSimulation::HopSimulation(const model::Model& model, const controllers::HoppingConfig& config,
                             const integrate::Options& options, const contact::Terrain& terrain, bool energy)
    : plant_(model, {}, terrain),
      loop_(model, config),
      energy_(energy),
      ode_(plant_, energy, false),
      integrator_(ode_, options),
      period_(config.period),
      outputs_(plant_.sensors()),
      command_(Eigen::VectorXd::Zero(plant_.motors())) {}

void HopSimulation::start(const Eigen::VectorXd& state) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(ode_.size());
  all.head(state.size()) = state;
  integrator_.start(0.0, all);
  samples_ = 0;
}

void HopSimulation::sample() {
  const double* x = integrator_.state().data();
  plant_.outputs(x, outputs_.data());
  touches_ = plant_.touches(x);
  loop_.command(outputs_, touches_, command_.data());
}

void HopSimulation::advance() {
  std::copy(command_.data(), command_.data() + command_.size(), ode_.command());
  integrator_.input_changed(true);
  ++samples_;
  integrator_.advance(time());
}

double HopSimulation::work() const { return energy_ ? integrator_.state()[plant_.states()] : 0.0; }

double HopSimulation::dissipated() const { return energy_ ? integrator_.state()[plant_.states() + 1] : 0.0; }

}  // namespace plumbline::validation
