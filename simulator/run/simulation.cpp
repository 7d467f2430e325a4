#include "simulator/run/simulation.h"

#include <algorithm>
#include <cmath>

namespace plumbline::run {
namespace {

/// Of a stretch over which a plate's force is averaged.
int pieces_of(double time) {
  constexpr double kPiece = 5e-5;  // s
  return std::max(1, static_cast<int>(std::ceil(time / kPiece)));
}

}  // namespace

Simulation::Simulation(model::Plant& plant, const SimulationOptions& options)
    : plant_(plant),
      with_energy_(options.energy),
      period_(options.period),
      ode_(plant, options.energy, options.events),
      integrator_(ode_, options.integrator),
      held_(Eigen::MatrixXd::Zero(plant.motors(), integrate::HeldCommands::depth(period_, plant.delays())),
            period_, plant.delays()),
      plates_(plant),
      outputs_(plant.sensors()) {}

void Simulation::start(const Eigen::VectorXd& state, double t0) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(ode_.size());
  all.head(state.size()) = state;
  t0_ = t0;
  samples_ = 0;
  accounted_ = false;
  holds_another_ = false;
  integrator_.start(t0, all);
}

void Simulation::hold(const Eigen::VectorXd& command) {
  std::copy(command.data(), command.data() + command.size(), ode_.command());
}

void Simulation::hold_until_first_arrives(const Eigen::VectorXd& command) {
  hold(command);
  for (Eigen::Index k = 0; k < held_.samples(); ++k) {
    held_.set(k, command.data());
  }
  holds_another_ = true;
}

void Simulation::measure() {
  const double* x = integrator_.state().data();
  plant_.outputs(x, outputs_.data(), ode_.command());
  plates_.write(outputs_.data());
  touches_ = plant_.touches(x);
  contact_forces_ = plant_.contact_forces(x);
}

void Simulation::account(const Eigen::VectorXd& command) {
  const double stored = plant_.energetics(integrator_.state().data(), command.data()).stored;
  accounted_ ? energy_.add(stored) : energy_.start(stored);
  accounted_ = true;
}

void Simulation::advance(const Eigen::VectorXd& command) {
  const Eigen::Index newest = held_.samples() - 1;
  for (Eigen::Index k = 0; samples_ == 0 && !holds_another_ && k <= newest; ++k) {
    held_.set(k, command.data());
  }
  held_.push(command.data());
  const auto sample = static_cast<double>(samples_);
  if (plates_.any()) {
    plates_.begin(time(), integrator_.state().data());
  }
  const std::vector<double>& breaks = held_.breaks();
  for (std::size_t b = 0; b < breaks.size(); ++b) {
    held_.at(newest, b, ode_.command());
    integrator_.input_changed(true);
    const double from = breaks[b];
    const double end = b + 1 < breaks.size() ? breaks[b + 1] : 1.0;
    const int pieces = plates_.any() ? pieces_of((end - from) * period_) : 1;
    for (int piece = 1; piece <= pieces; ++piece) {
      const double part = from + (end - from) * piece / pieces;
      const double t = t0_ + (sample + part) * period_;
      integrator_.advance(t);
      plates_.add(t, integrator_.state().data());
    }
  }
  ++samples_;
}

}  // namespace plumbline::run
