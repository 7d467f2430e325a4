#include "simulator/run/sampled_run.h"

namespace plumbline::run {

SampledOptions::SampledOptions() {
  integrator.method = integrate::Method::rosenbrock;
  integrator.weight = integrate::Weight::reach;
  integrator.set_tolerance(1e-5);
  integrator.max_steps = 2000;  // in a sample; more is no progress
}

SampledRun::SampledRun(const model::Model& model, const contact::Terrain& terrain,
                       const ControllerSetup* setup, const SampledOptions& options)
    : energy_(options.energy),
      plant_(model, {}, terrain),
      sensors_(plant_.model(), options.sensors),
      controller_(setup == nullptr ? nullptr : std::make_unique<WiredController>(model, *setup)),
      simulation_(plant_, {options.integrator, setup == nullptr ? options.period : setup->period,
                           options.energy, false}),
      command_(Eigen::VectorXd::Zero(plant_.motors())) {}

void SampledRun::show_past(const Eigen::VectorXd& outputs) {
  if (controller_ == nullptr) {
    return;
  }
  std::vector<model::Touch> above(plant_.model().feet.size());
  sensors_.read(outputs, above, sensed_);
  Eigen::VectorXd nowhere = Eigen::VectorXd::Zero(plant_.motors());
  controller_->step(sensed_, nowhere.data());
}

void SampledRun::sample() {
  simulation_.measure();
  if (simulation_.outputs().allFinite()) {
    sensors_.read(simulation_.outputs(), simulation_.touches(), sensed_);
    if (controller_ != nullptr) {
      controller_->step(sensed_, command_.data());
    }
  }
  if (energy_) {
    simulation_.account(command_);
  }
}

}  // namespace plumbline::run
