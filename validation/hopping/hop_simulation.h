// A robot and its hopping controller, one sample after the other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/terrain.h"
#include "controllers/mabel_hopping/hopping_config.h"
#include "simulator/integrate/held_commands.h"
#include "simulator/integrate/integrator.h"
#include "simulator/integrate/plant_ode.h"
#include "simulator/model/model.h"
#include "simulator/model/plant.h"
#include "validation/hopping/hopping_loop.h"

namespace plumbline::validation {

/// start, then sample and advance by turns. Not copyable: the integrator holds on to the plant.
class HopSimulation {
 public:
  /// `energy`: the motors' work and the dissipated energy are integrated too. Throws InputError for a model
  /// that cannot hop.
  HopSimulation(const model::Model& model, const controllers::HoppingConfig& config,
                const integrate::Options& options, const contact::Terrain& terrain = {}, bool energy = false);

  /// Begins at time 0; the controller stays as it is. Where the model delays a command, the first one holds
  /// until it arrives.
  void start(const Eigen::VectorXd& state);
  /// Measures, and lets the controller command what holds until the next sample.
  void sample();
  /// To the next sample. Throws std::runtime_error when the integrator gives up.
  void advance();

  double time() const { return static_cast<double>(samples_) * period_; }
  Eigen::VectorXd state() const { return integrator_.state().head(plant_.states()); }
  double work() const;        ///< of the motors since the start, J; with energy only
  double dissipated() const;  ///< since the start, J; with energy only
  const Eigen::VectorXd& outputs() const { return outputs_; }            ///< at the last sample
  const std::vector<model::Touch>& touches() const { return touches_; }  ///< at the last sample
  const Eigen::VectorXd& command() const { return command_; }
  model::Plant& plant() { return plant_; }
  const model::Plant& plant() const { return plant_; }
  HoppingLoop& loop() { return loop_; }
  const HoppingLoop& loop() const { return loop_; }
  integrate::Summary summary() const { return integrator_.summary(); }

 private:
  model::Plant plant_;
  HoppingLoop loop_;
  bool energy_;
  integrate::PlantOde ode_;
  integrate::Integrator integrator_;
  double period_;
  integrate::HeldCommands held_;
  long samples_ = 0;
  Eigen::VectorXd outputs_, command_;
  std::vector<model::Touch> touches_;
};

}  // namespace plumbline::validation
