// The equations of motion of a Plant: bodies, drivetrain and effects as they act on the independent
// coordinates.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/coordinate_map.h"
#include "simulator/model/ground_feet.h"
#include "simulator/model/link_contacts.h"
#include "simulator/model/model.h"
#include "simulator/model/plant_slots.h"
#include "simulator/model/plant_values.h"
#include "simulator/model/released_rods.h"
#include "simulator/model/rigid_bodies.h"
#include "simulator/model/sensor_losses.h"

namespace plumbline::model {

/// Owns the model and what its effects' values are now; knows where each effect acts. What is built on it
/// (slopes, readings, the energy account) sees the slots and what the last evaluation left. See Plant for the
/// equations. Stays where it is made: its parts refer to its model and values.
class PlantDynamics {
 public:
  /// Throws as Plant does.
  PlantDynamics(const Model& model, const std::vector<Lock>& locks, contact::Terrain terrain);
  PlantDynamics(const PlantDynamics&) = delete;
  PlantDynamics& operator=(const PlantDynamics&) = delete;

  const Model& model() const { return model_; }
  const CoordinateMap& map() const { return map_; }
  RigidBodies& bodies() { return bodies_; }
  const RigidBodies& bodies() const { return bodies_; }
  int positions() const { return nz_; }
  int states() const { return nx_; }
  int motors() const { return static_cast<int>(model_.motors.size()); }
  std::vector<std::string> state_names() const;

  /// Of an effect of the model. Whoever moves one of stored() for a while calls change_ground() where the
  /// effect is one of a contact.
  const double* values(int effect) const { return values_[static_cast<std::size_t>(effect)].data(); }
  effects::Values& stored(int effect) { return values_[static_cast<std::size_t>(effect)]; }
  /// The same of all, as the effects that change the ground leave them.
  const std::vector<effects::Values>& on_ground() const { return on_ground_; }
  void change_ground();
  /// True where other bodies follow from it.
  bool set_value(ParameterId id, double value);

  const std::vector<ForceSlot>& forces() const { return forces_; }
  /// By motor, in order of action; behind them one chain of what they all hang on.
  const std::vector<std::vector<ActuatorSlot>>& actuators() const { return actuators_; }
  const std::vector<LinearForm>& motor_lines() const { return motor_lines_; }
  GroundFeet& feet() { return feet_; }
  const GroundFeet& feet() const { return feet_; }
  const LinkContacts* links() const { return links_.get(); }  ///< null: none that has a law
  const SensorLosses& losses() const { return losses_; }
  bool meets_anything() const { return !feet_.empty() || links_ != nullptr; }
  int link_points() const { return links_ == nullptr ? 0 : links_->points(); }

  /// As those of Plant.
  void rate(const double* x, const double* command, double* xdot);
  Eigen::VectorXd fall(const double* x);
  Eigen::VectorXd equilibrium(const Eigen::VectorXd& z, const double* command);
  int switch_count() const { return switch_count_; }
  void switches(const double* x, double* g);
  std::vector<ForceJump> jumps() const;
  double delay(int motor) const;
  double switch_lateness(const std::string& contact_switch, bool closes) const;
  Eigen::RowVectorXd switch_lateness_slope(const std::string& contact_switch, bool closes,
                                           const std::vector<ParameterId>& parameters) const;
  std::vector<Touch> touches(const double* x);
  std::vector<LinkTouch> link_touches(const double* x);
  FootDepth foot_depth(int foot, const double* x);
  Eigen::RowVectorXd depth_slope(int foot, const double* x);

  /// From the command (torque units) through all actuator effects to the delivered torque. State rates are
  /// written when xdot is given.
  double actuator_chain(int motor, const double* x, double commanded, double* xdot) const;
  void deliver_torques(const double* x, const double* command, double* xdot);
  /// Rods that stretch point along themselves at x, where rigid_at() has been.
  void aim_rods(const double* x);
  ReleasedRods& rods() { return rods_; }
  /// How far a rod is stretched at x; one that holds is not.
  effects::Motion rod_motion(const std::string& rod, const double* x);
  /// Position, velocity and load as a law sees them.
  effects::Motion motion(const ForceSlot& slot, const double* x) const;
  /// Generalised forces of the links on each other, where rigid_at() has left the tree.
  void add_links(const double* x, Eigen::VectorXd& Q, double* xdot);

  /// What rate() was last called with led to: torques, generalised forces less h, d2z/dt2.
  const Eigen::VectorXd& torques() const { return torque_; }
  const Eigen::VectorXd& forces_less_bias() const { return Q_; }
  const Eigen::VectorXd& acceleration() const { return acceleration_; }

 private:
  void place_effects();
  void place_force(const effects::ForceLaw& law, int effect, int& next_state);
  void place_links(int& next_state);
  void find_gear_loads(const double* x);
  void add_forces(const double* x, Eigen::VectorXd& Q, double* xdot);

  Model model_;
  std::vector<effects::Values> values_, on_ground_;
  CoordinateMap map_;
  RigidBodies bodies_;
  const int n_tree_, nz_;
  int nx_ = 0, switch_count_ = 0;
  bool gear_friction_ = false;     // does a law feel what a gear passes on?
  Eigen::VectorXd motor_pulleys_;  // inertia that turns with each motor beside its rotor
  std::vector<ForceSlot> forces_;
  std::vector<std::vector<ActuatorSlot>> actuators_;
  std::vector<SwitchSlot> switch_effects_;
  std::vector<LinearForm> motor_lines_;
  GroundFeet feet_;
  std::unique_ptr<LinkContacts> links_;
  ReleasedRods rods_;
  SensorLosses losses_;

  // Work space of the last evaluation.
  Eigen::VectorXd Q_, torque_, acceleration_, on_joints_;
  Eigen::VectorXd gear_load_;  // what the motors' gears pass on; only where a law feels it
  std::vector<double> switch_values_;
};

}  // namespace plumbline::model
