// A plant under commands that are held over samples: the one loop of everything that runs a robot.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "simulator/integrate/energy_account.h"
#include "simulator/integrate/held_commands.h"
#include "simulator/integrate/integrator.h"
#include "simulator/integrate/plant_ode.h"
#include "simulator/integrate/plate_means.h"
#include "simulator/model/plant.h"

namespace plumbline::run {

struct SimulationOptions {
  integrate::Options integrator;
  double period = 1e-3;  ///< s between two samples
  bool energy = false;   ///< integrate the motors' work and the dissipated energy beside the motion
  bool events = false;   ///< locate the effects' switching functions
};

/// start, then measure and advance by turns. Not copyable: the integrator holds on to the plant, which must
/// outlive this object.
class Simulation {
 public:
  Simulation(model::Plant& plant, const SimulationOptions& options);
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Begins at t0. Where the model delays a command, the first one holds until it arrives, unless
  /// another one is said to.
  void start(const Eigen::VectorXd& state, double t0 = 0.0);
  /// The command that held before the start, which accelerometers feel at the first sample; zero by itself.
  void hold(const Eigen::VectorXd& command);
  /// Beside that: what holds where the model delays a command, until the first one arrives.
  void hold_until_first_arrives(const Eigen::VectorXd& command);
  /// Looks at the present sample: outputs() and touches() are of it from now on.
  void measure();
  /// To the next sample, under a command for each motor (command units). Throws std::runtime_error when the
  /// integrator gives up.
  void advance(const Eigen::VectorXd& command);

  double time() const { return t0_ + static_cast<double>(samples_) * period_; }
  long samples() const { return samples_; }  ///< advanced so far
  double period() const { return period_; }
  Eigen::VectorXd state() const { return integrator_.state().head(plant_.states()); }
  /// Of all sensors at the last measure(), true: neither counts nor noise. A force plate's is its mean over
  /// the sample.
  const Eigen::VectorXd& outputs() const { return outputs_; }
  const std::vector<model::Touch>& touches() const { return touches_; }
  /// Plant::contact_forces() at the last measure().
  const std::vector<Eigen::Vector3d>& contact_forces() const { return contact_forces_; }
  /// The energy's account at this sample, under the command that is about to hold (with energy only).
  void account(const Eigen::VectorXd& command);
  double energy_error() const { return energy_.error(work(), dissipated()); }          ///< J
  double energy_exchanged() const { return energy_.exchanged(work(), dissipated()); }  ///< J
  const std::vector<integrate::Event>& events() const { return integrator_.events(); }
  integrate::Summary summary() const { return integrator_.summary(); }
  model::Plant& plant() { return plant_; }
  const model::Plant& plant() const { return plant_; }

 private:
  double work() const { return with_energy_ ? integrator_.state()[plant_.states()] : 0.0; }
  double dissipated() const { return with_energy_ ? integrator_.state()[plant_.states() + 1] : 0.0; }

  model::Plant& plant_;
  bool with_energy_;
  double period_, t0_ = 0.0;
  integrate::PlantOde ode_;
  integrate::Integrator integrator_;
  integrate::HeldCommands held_;
  integrate::PlateMeans plates_;
  integrate::EnergyAccount energy_;
  bool accounted_ = false;
  bool holds_another_ = false;  // until the first command arrives
  long samples_ = 0;
  Eigen::VectorXd outputs_;
  std::vector<model::Touch> touches_;
  std::vector<Eigen::Vector3d> contact_forces_;
};

}  // namespace plumbline::run
