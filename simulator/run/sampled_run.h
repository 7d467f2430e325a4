// A robot, its sensors and its controller, one sample after the other.
#pragma once

#include <memory>

#include "contact/terrain.h"
#include "simulator/run/controller_setup.h"
#include "simulator/run/sensors.h"
#include "simulator/run/simulation.h"
#include "simulator/run/wired_controller.h"

namespace plumbline::run {

struct SampledOptions {
  integrate::Options integrator;
  SensorOptions sensors;
  double period = 1e-3;  ///< s, without a controller
  bool energy = false;   ///< integrate work and dissipation, too; the steps are then a little different
  /// rosenbrock at 1e-5 with the Ode's reach as weight: errors below 1e-4 for a legged robot
  /// (docs/design.md, Integration).
  SampledOptions();
};

/// start, then sample and advance by turns. Not copyable.
class SampledRun {
 public:
  /// `setup` nullptr: no controller, every motor is commanded 0. Throws InputError when model and controller
  /// do not fit together.
  SampledRun(const model::Model& model, const contact::Terrain& terrain, const ControllerSetup* setup,
             const SampledOptions& options);
  SampledRun(const SampledRun&) = delete;
  SampledRun& operator=(const SampledRun&) = delete;

  /// Begins at time 0; the controller stays as it is.
  void start(const Eigen::VectorXd& state) { simulation_.start(state); }
  /// Shows the controller a sample of the past, with all switches open: `outputs` are true positions of all
  /// sensors. Its commands go nowhere.
  void show_past(const Eigen::VectorXd& outputs);
  /// Reads the sensors once, and lets the controller command what holds until the next sample. Nothing is
  /// read where the state is not finite any more.
  void sample();
  /// To the next sample. Throws std::runtime_error when the integrator gives up.
  void advance() { simulation_.advance(command_); }

  Simulation& simulation() { return simulation_; }
  const Simulation& simulation() const { return simulation_; }
  model::Plant& plant() { return plant_; }
  const Sensed& sensed() const { return sensed_; }
  const Eigen::VectorXd& command() const { return command_; }
  WiredController* controller() { return controller_.get(); }
  const WiredController* controller() const { return controller_.get(); }

 private:
  bool energy_;
  model::Plant plant_;
  Sensors sensors_;
  std::unique_ptr<WiredController> controller_;
  Simulation simulation_;
  Sensed sensed_;
  Eigen::VectorXd command_;
};

}  // namespace plumbline::run
