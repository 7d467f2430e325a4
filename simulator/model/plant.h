// A model ready to be integrated: skeleton, drivetrain and effects as one first-order system.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/link_contacts.h"
#include "simulator/model/loop_closure.h"
#include "simulator/model/model.h"
#include "simulator/model/plant_values.h"
#include "simulator/model/tree_dynamics.h"

namespace plumbline::model {

class PlantDynamics;
class PlantReadings;
class PlantTangent;

/// The state is x = [z, dz/dt, hidden states], z the independent positions that the rigid ratios and locks
/// leave: q = S z + q0 for the full coordinates q (joints, motors, pulleys). Ratios are linear with constant
/// coefficients, so this elimination is exact and nothing drifts:
///   (S' M S) d2z/dt2 = S' (Q - h).
/// Closed loops are not linear: z then still holds the loops' own joints, and the loops hold them by forces,
///   (S' M S) d2z/dt2 = S' (Q - h) + J' lambda,   J d2z/dt2 + (dJ/dt) dz/dt = 0,   J = dphi/dz (loop_rows.h),
/// so that states move along phi(z) = 0; close_loops() takes off what an integrator's step leaves.
/// Motors and pulleys turn relative to their mount; the mount's own motion adds nothing to their energy
/// (exact for a fixed mount). Not thread-safe: one object for each thread.
class Plant {
 public:
  /// Throws InputError when constraints contradict each other or the mass matrix is singular.
  /// The same for loops (LoopClosure).
  Plant(const Model& model, const std::vector<Lock>& locks, contact::Terrain terrain = {});
  ~Plant();
  Plant(Plant&&) noexcept;
  Plant& operator=(Plant&&) noexcept;

  const Model& model() const;
  const contact::Terrain& terrain() const;
  int positions() const;
  int states() const;
  int motors() const;
  int sensors() const;
  /// "position of mLA_left", "velocity of ..." (joint, motor or pulley), "bristle of lugre at mLS".
  std::vector<std::string> state_names() const;
  /// Indices in x of the hidden states that the past determines: those of force laws (bristles), which follow
  /// the motion, those of actuators, which follow the commands, and what sensors have lost.
  std::vector<int> carried_states() const;
  /// The effects whose parameters decide what they are carried to.
  std::vector<int> carried_state_effects() const;

  /// Time derivative of the state for the commands that hold now (delayed already, in command units). Throws
  /// std::runtime_error where a free or ball joint is at its chart's singularity (joint_chain.h).
  void rate(const double* x, const double* command, double* xdot);

  /// Are there closed loops that hold, so that not every x is a state of the model? A rod that an effect lets
  /// stretch holds nothing.
  bool has_loops() const;
  /// What closes those that hold, and what closes all of them with rods at their length, for a start; null
  /// where there are none.
  LoopClosure* holding();
  LoopClosure* closure();
  /// Another one of all, for whoever outlives this plant or holds it const.
  std::unique_ptr<LoopClosure> own_closure() const;
  /// A position in which all loops are closed; without loops zero.
  Eigen::VectorXd home() const;
  /// Moves x onto the loops: positions by M^-1 J' until phi = 0 to rounding, then velocities until J w = 0.
  /// Returns the largest of phi before, m. Throws std::runtime_error where they cannot be closed.
  double close_loops(double* x);
  /// Largest of phi, m, and of J w, m/s, at x.
  Eigen::Vector2d loop_errors(const double* x);
  /// d(close_loops(x))/dx over positions and velocities where x is closed, 2 positions x 2 positions.
  Eigen::MatrixXd closing_slope(const double* x);

  /// d2z/dt2 of a start at rest under gravity alone, without any effect's force.
  Eigen::VectorXd fall(const double* x);

  /// What the sensors would read without quantisation and noise, SI. Accelerometers need the commands that
  /// hold (delayed already); null: all are zero. Of an orientation the rotation vector of the sensor's axes
  /// in the world, R = exp([y]), |y| <= pi.
  void outputs(const double* x, double* y, const double* command = nullptr);
  /// d(what a sensor truly sees)/dz, of a rate sensor /d(dz/dt), sensors x positions; the rows of force
  /// plates and of what is measured at points of links are zero.
  const Eigen::MatrixXd& output_map() const;
  /// True position of each sensor at z = 0.
  const Eigen::VectorXd& output_offset() const;
  /// Does an effect let this ratio, or this rod of a loop, stretch?
  bool lets_stretch(const std::string& name) const;
  /// Rows that are zero when no released ratio is stretched (for an unobserved start).
  const Eigen::MatrixXd& stretch_map() const;

  /// The tree of links, at the positions and velocities evaluated last; the index of a sensor's link in it;
  /// and the joints' positions S z + q0 that it is placed by: S.
  const TreeDynamics& tree() const;
  int tree_body_of_sensor(int sensor) const;
  const Eigen::MatrixXd& joint_map() const;

  /// The model's feet, in its order; one that no ground law holds reads zeros.
  std::vector<Touch> touches(const double* x);
  /// Does any foot have a ground that presses?
  bool meets_ground() const;
  /// Points at which links of the model may meet each other: those of its contacts that have a law.
  int link_points() const;
  /// Of all of them.
  std::vector<LinkTouch> link_touches(const double* x);
  /// On the first link of each of the model's contacts, in the world's axes, N.
  std::vector<Eigen::Vector3d> contact_forces(const double* x);
  /// Does anything press on the links that begins where they meet something?
  bool meets_anything() const;
  /// Of one of the model's feet that has a ground; far above the ground where it has none.
  FootDepth foot_depth(int foot, const double* x);
  /// d(depth)/dz on level ground, 1 x positions; and d(depth)/d(parameters), 1 x parameters.
  Eigen::RowVectorXd depth_slope(int foot, const double* x);
  Eigen::RowVectorXd depth_slope(int foot, const double* x, const std::vector<ParameterId>& parameters);

  /// How much later than the model says of it a contact switch reads its foot's touchdown (`closes`) or
  /// lift-off, s: by the effects at it. And d(that)/d(parameters), 1 x parameters.
  double switch_lateness(const std::string& contact_switch, bool closes) const;
  Eigen::RowVectorXd switch_lateness_slope(const std::string& contact_switch, bool closes,
                                           const std::vector<ParameterId>& parameters) const;

  /// Pure delay of a motor's command, s.
  double delay(int motor) const;
  std::vector<double> delays() const;   ///< of all motors
  double torque_gain(int motor) const;  ///< torque per command unit

  /// Hidden states in equilibrium with the commands, written behind the positions and velocities of x.
  void settle(const double* command, double* x) const;

  /// The states of carried_states() carried in h seconds along a known motion from `from` to `to`, under
  /// commands that hold meanwhile (delayed already); written behind the positions and velocities of x. By the
  /// exponential Euler method at the middle (Hochbruck and Ostermann, Acta Numerica 19, 2010), stable for
  /// stiff bristles and exact for laws that are linear in their states, however fast. What sensors have lost
  /// is left to carry_losses().
  void carry_states(const double* from, const double* to, const double* command, double h, double* x) const;

  /// Does any sensor lose something of what it shows (effects/losing_sensor_law.h)?
  bool loses_counts() const;
  /// The states of what a sensor has lost, 0 where the record begins, carried on over samples of h seconds in
  /// which its reading changed at `rates`: what the sensor itself showed is enough to say what it missed,
  /// whatever other sensors make of the motion. The sensor's other laws are taken to show rates as they are.
  void carry_losses(int sensor, const Eigen::VectorXd& rates, double h, double* x) const;

  /// Switching functions of all force laws.
  int switch_count() const;
  void switches(const double* x, double* g);
  /// Which of them are zero where a force jumps (ForceLaw::jumps), and whose effect that is.
  using Jump = ForceJump;
  std::vector<Jump> jumps() const;

  Energetics energetics(const double* x, const double* command);
  /// The same for the state and command that rate() was last called with, `stored` without the rigid bodies'
  /// share: what an integrated account needs, and much cheaper.
  Energetics powers(const double* x) const;

  /// Static equilibrium near z (velocities zero) under constant commands, by Newton's method.
  /// Throws std::runtime_error when none is found.
  Eigen::VectorXd equilibrium(const Eigen::VectorXd& z, const double* command);

  /// Positions of all joints that move, in the skeleton's order: what body_poses() takes.
  Eigen::VectorXd joint_positions(const double* x) const;
  /// Full coordinate value of a named joint, coordinate or motor.
  double position_of(const std::string& name, const double* x) const;
  double velocity_of(const std::string& name, const double* x) const;
  /// Raises each speed to the one at which its coordinate alone would hold the kinetic energy of x:
  /// v_i = sqrt(w' M w / M_ii), w = dz/dt.
  void raise_speeds(const double* x, double* speeds);
  /// Of the independent coordinates, at the position that rate() was last called with.
  const Eigen::MatrixXd& mass_matrix() const;
  /// Generalised inertia felt along a named place at the last evaluated position.
  double inertia_of(const std::string& name);
  /// The coordinate whose own motion, with the loops open, changes a rod's length most in the position
  /// home(), and that change over its own, m/rad or 1.
  struct Lever {
    std::string coordinate;
    double travel = 0.0;
  };
  Lever lever_of(const std::string& rod) const;

  /// Position and velocity as a place's law sees them (stretch for a ratio).
  effects::Motion motion_at(effects::Place place, const std::string& at, const double* x) const;

  /// The parameter's value now; set_value changes it in place. Setting must not make an effect null or not
  /// null when it carries states or releases a ratio (build a new Plant for that).
  double value(ParameterId id) const;
  void set_value(ParameterId id, double value);

  /// Linearisation of rate() over a sample: A = d(rate)/dx (states x states), B = d(rate)/d(parameters).
  /// Rigid-body parts of A and of structural parameters are refreshed only when `refresh` is true: they vary
  /// slowly against the sample period. The effects' slopes are means over the sample, which a law that turns
  /// within it (dry friction, a contact) needs.
  void tangent(const SampleMotion& sample, const std::vector<ParameterId>& parameters,
               const Eigen::VectorXd& steps, bool refresh, Eigen::MatrixXd& A, Eigen::MatrixXd& B);
  /// d(outputs)/d(parameters) at x, sensors x parameters.
  void output_tangent(const double* x, const std::vector<ParameterId>& parameters,
                      const Eigen::VectorXd& steps, Eigen::MatrixXd& D);
  /// d(outputs)/d(positions, velocities) with the sensors' own scale effects, sensors x 2 positions, or
  /// d(outputs)/dx, sensors x states, where a sensor loses counts; a force plate's row is zero. Of an
  /// orientation: the turn about the sensor's own axes. Of an accelerometer: with the accelerations d2z/dt2
  /// held that `command` gives; what their change adds is acceleration_map().
  void output_jacobian(const double* x, Eigen::MatrixXd& C, const double* command = nullptr);
  /// d(outputs)/d(d2z/dt2), sensors x positions: of accelerometers, zero for all others.
  Eigen::MatrixXd acceleration_map(const double* x);

  /// Approximate d(rate)/dx for implicit integrators: mass matrix and the effects' own slopes, no further
  /// forward dynamics.
  void stiff_jacobian(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A);
  /// The effect with the largest spectral radius of the equations linearised at x when its slopes alone act
  /// on the whole mass matrix. Of a foot: its normal law alone, and all its laws, named by the tangential
  /// one.
  Stiffest stiffest(const double* x, const double* command);

 private:
  std::unique_ptr<PlantDynamics> dynamics_;
  std::unique_ptr<PlantTangent> tangent_;
  std::unique_ptr<PlantReadings> readings_;
};

}  // namespace plumbline::model
