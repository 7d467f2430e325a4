#include "validation/hopping/hop_simulation.h"

namespace plumbline::validation {

HopSimulation::HopSimulation(const model::Model& model, const controllers::HoppingConfig& config,
                             const integrate::Options& options, const contact::Terrain& terrain, bool energy)
    : plant_(model, {}, terrain),
      loop_(model, config),
      energy_(energy),
      ode_(plant_, energy, false),
      integrator_(ode_, options),
      period_(config.period),
      held_(Eigen::MatrixXd::Zero(plant_.motors(), integrate::HeldCommands::depth(period_, plant_.delays())),
            period_, plant_.delays()),
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
  const Eigen::Index newest = held_.samples() - 1;
  for (Eigen::Index k = 0; k < (samples_ == 0 ? newest : 0); ++k) {
    held_.set(k, command_.data());
  }
  held_.push(command_.data());
  const std::vector<double>& breaks = held_.breaks();
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    held_.at(newest, b, ode_.command());
    integrator_.input_changed(true);
    const double end = b + 1 < breaks.size() ? breaks[b + 1] : 1.0;
    integrator_.advance((static_cast<double>(samples_) + end) * period_);
  }
  ++samples_;
}

double HopSimulation::work() const { return energy_ ? integrator_.state()[plant_.states()] : 0.0; }

double HopSimulation::dissipated() const { return energy_ ? integrator_.state()[plant_.states() + 1] : 0.0; }

}  // namespace plumbline::validation
