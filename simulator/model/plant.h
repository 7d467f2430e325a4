// A model ready to be integrated: skeleton, drivetrain and effects as one first-order system.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/contact_laws.h"
#include "simulator/model/link_contacts.h"
#include "simulator/model/loop_closure.h"
#include "simulator/model/mechanism.h"
#include "simulator/model/model.h"
#include "simulator/model/tree_slopes.h"

namespace plumbline::model {

/// A parameter of one of the model's effects.
struct ParameterId {
  int effect = 0;     ///< index in Model::effects
  int parameter = 0;  ///< index in the law's declaration
};

/// Motion over a short time in which commands are held.
struct SampleMotion {
  const double* middle;         ///< mean of the states at both ends
  const double* change;         ///< state at the end less state at the start
  const double* command;        ///< of each motor, mean over the sample
  const double* command_slope;  ///< d(command)/d(delay) of each motor, 1/s
  double period;                ///< s
  double hold = 0.0;            ///< s for which a command holds, where that is longer; 0: the period
  bool jumped = false;          ///< a force jumped where it begins
};

/// A foot and the ground under it, in the world's axes.
struct Touch {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  ///< m/s
  double depth = 0.0;                                  ///< in the ground when above 0, m
  /// Of its link (the frame's y) along the ground; of a robot that floats, where friction is alike in all
  /// directions, of the world: a link that tumbles has no left.
  Eigen::Vector2d left = Eigen::Vector2d::UnitY();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< of the ground on the foot, N
};

/// How deep a foot is in the ground (under 0: above it), m, and its rate, m/s.
struct FootDepth {
  double depth = 0.0;
  double rate = 0.0;
};

/// Energy of a state and where power goes.
struct Energetics {
  double stored = 0.0;      ///< kinetic, gravity and springs, J
  double input = 0.0;       ///< power of the motors' delivered torques, W
  double dissipated = 0.0;  ///< by all effects, W
};

/// What moves a state fastest.
struct Stiffest {
  std::string element;  ///< "hard_stop at bsp_left"; empty when no effect moves anything
  double rate = 0.0;    ///< 1/s
};

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

  const Model& model() const { return model_; }
  const contact::Terrain& terrain() const { return terrain_; }
  int positions() const { return nz_; }
  int states() const { return nx_; }
  int motors() const { return static_cast<int>(model_.motors.size()); }
  int sensors() const { return static_cast<int>(model_.sensors.size()); }
  /// "position of mLA_left", "velocity of ..." (joint, motor or pulley), "bristle of lugre at mLS".
  std::vector<std::string> state_names() const;
  /// Indices in x of the hidden states that the past determines: those of force laws (bristles), which follow
  /// the motion, and those of actuators, which follow the commands.
  std::vector<int> carried_states() const;
  /// The effects whose parameters decide what they are carried to.
  std::vector<int> carried_state_effects() const;

  /// Time derivative of the state for the commands that hold now (delayed already, in command units). Throws
  /// std::runtime_error where a free or ball joint is at its chart's singularity (joint_chain.h).
  void rate(const double* x, const double* command, double* xdot);

  /// Are there closed loops, so that not every x is a state of the model?
  bool has_loops() const { return closure_ != nullptr; }
  /// What closes them; null where there are none.
  LoopClosure* closure() { return closure_.get(); }
  /// Another one, for whoever outlives this plant or holds it const.
  std::unique_ptr<LoopClosure> own_closure() const;
  /// A position in which the loops are closed; without loops zero.
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
  const Eigen::MatrixXd& output_map() const { return output_map_; }
  /// True position of each sensor at z = 0.
  const Eigen::VectorXd& output_offset() const { return output_offset_; }
  /// Rows that are zero when no released ratio is stretched (for an unobserved start).
  const Eigen::MatrixXd& stretch_map() const { return stretch_map_; }

  /// The tree of links, at the positions and velocities evaluated last; the index of a sensor's link in it;
  /// and the joints' positions S z + q0 that it is placed by: S.
  const TreeDynamics& tree() const { return structure_.mechanism->tree(); }
  int tree_body_of_sensor(int sensor) const;
  const Eigen::MatrixXd& joint_map() const { return S_tree_; }

  /// The model's feet, in its order; one that no ground law holds reads zeros.
  std::vector<Touch> touches(const double* x);
  /// Does any foot have a ground that presses?
  bool meets_ground() const { return !feet_.empty(); }
  /// Points at which links of the model may meet each other: those of its contacts that have a law.
  int link_points() const { return links_ == nullptr ? 0 : links_->points(); }
  /// Of all of them.
  std::vector<LinkTouch> link_touches(const double* x);
  /// On the first link of each of the model's contacts, in the world's axes, N.
  std::vector<Eigen::Vector3d> contact_forces(const double* x);
  /// Does anything press on the links that begins where they meet something?
  bool meets_anything() const { return meets_ground() || links_ != nullptr; }
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
  /// stiff bristles and exact for a lag of first order; a law's states that are several by the linearly
  /// implicit midpoint rule.
  void carry_states(const double* from, const double* to, const double* command, double h, double* x) const;

  /// Switching functions of all force laws.
  int switch_count() const { return switch_count_; }
  void switches(const double* x, double* g);
  /// Which of them are zero where a force jumps (ForceLaw::jumps), and whose effect that is.
  struct Jump {
    int index = 0;   ///< switching function
    int effect = 0;  ///< of the model
  };
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
  const Eigen::MatrixXd& mass_matrix() const { return M_; }
  /// Generalised inertia felt along a named place at the last evaluated position.
  double inertia_of(const std::string& name);

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
  /// d(outputs)/d(positions, velocities) with the sensors' own scale effects, sensors x 2 positions; a force
  /// plate's row is zero. Of an orientation: the turn about the sensor's own axes. Of an accelerometer: with
  /// the accelerations d2z/dt2 held that `command` gives; what their change adds is acceleration_map().
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
  using Few = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;  // a law's states: no heap in a hot loop
  struct Entry {
    int index;
    double value;
  };
  // A linear functional of the full coordinates, seen from the independent ones.
  struct Line {
    Eigen::VectorXd full;
    Eigen::VectorXd reduced;
    double offset = 0.0;
    std::vector<Entry> entries;  // of `reduced`, those that are not zero: few
  };
  struct ForceSlot {
    const effects::ForceLaw* law = nullptr;
    int effect = 0;
    int state = -1;         // index in x of its first hidden state
    int motor = -1;         // motor whose torque is the load
    bool at_motor = false;  // acts on that motor itself, not on its gear
    bool active = true;     // false at null values: costs nothing
    Line line;
  };
  struct Reach {
    double up = 0.0, down = 0.0;
  };
  struct FootSlot : ContactLaws {
    int foot = 0;             // index in the model
    int body = -1;            // in the mechanism's tree
    bool keeps_axes = false;  // its bristles lie in the world's axes, not in those of its link
  };
  struct ActuatorSlot {
    const effects::ActuatorLaw* law = nullptr;
    int effect = 0;
    int state = -1;
  };
  struct StructureSlot {
    const effects::StructureLaw* law = nullptr;
    int effect = 0;
  };
  struct SensorSlot {
    const effects::SensorLaw* law = nullptr;
    int effect = 0;
  };
  struct SwitchSlot {
    const effects::SwitchLaw* law = nullptr;
    int effect = 0;
  };
  struct PointSlot {
    int sensor = 0;  // index in the model
    int body = -1;   // in the mechanism's tree
  };
  struct Structure {
    std::unique_ptr<Mechanism> mechanism;
    Eigen::VectorXd extra_inertia;  // on all full coordinates, diagonal
    Eigen::MatrixXd extra_reduced;  // S' (diag + pulleys) S
  };
  /// Perturbed by one structural parameter.
  struct Variant {
    ParameterId id;
    double step = 0.0;
    Structure structure;
    std::vector<int> heavier;  // bodies of the tree whose mass, centre of mass or inertia is another
    Eigen::MatrixXd dM;        // by differences, only where gravity is another
    Eigen::VectorXd dh;
  };

  Eigen::VectorXd full_direction(const std::string& name) const;
  Eigen::VectorXd stretch_direction(const Ratio& ratio) const;
  Line line_of(const Eigen::VectorXd& full) const;
  bool is_released(const Ratio& ratio) const;
  void check_charts() const;
  void reduce(const std::vector<Lock>& locks);
  void place_effects();
  void place_force(const effects::ForceLaw& law, int effect, int& next_state);
  void place_sensors();
  void place_ground(int& next_state);
  void place_links(int& next_state);
  void add_links(const double* x, Eigen::VectorXd& Q, double* xdot);
  void link_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A);
  void link_parameter_tangent(const double* x, ParameterId id, double step, effects::Values moved,
                              Eigen::Ref<Eigen::VectorXd> column);
  void link_energetics(const double* x, Energetics& e) const;
  void find_feet();
  void change_ground();
  Eigen::Vector3d below(const FootSlot& slot) const;
  const FootSlot* slot_of(int foot) const;
  void ground_parameter_tangent(const FootSlot& slot, const double* x, ParameterId id, double step,
                                effects::Values moved, Eigen::Ref<Eigen::VectorXd> column);
  Touch touch(const FootSlot& slot) const;
  void press(const FootSlot& slot, const double* x, Touch& touch, double* xdot) const;
  void add_ground(const double* x, Eigen::VectorXd& Q, double* xdot);
  const Eigen::MatrixXd& foot_jacobian(const FootSlot& slot, const Touch& at);
  void ground_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A);
  void foot_tangent(const FootSlot& slot, const Touch& at, const Touch& half, double* x,
                    Eigen::Ref<Eigen::MatrixXd> A);
  void find_turning(const FootSlot& slot, const Touch& at);
  void leverage_tangent(const FootSlot& slot, const Touch& at, const double* x);
  void bristle_tangent(const FootSlot& slot, const Touch& at, double* x, Eigen::Ref<Eigen::MatrixXd> A);
  void ground_energetics(const double* x, Energetics& e) const;
  void plate_outputs(const double* x, double* y);
  void place_point_sensor(int sensor);
  void point_outputs(const double* x, const double* command, double* y);
  void point_jacobian(const double* x, const double* command, Eigen::MatrixXd& C);
  void feel_points(Eigen::VectorXd acceleration, Eigen::MatrixXd& C);
  Eigen::VectorXd accelerations_at(const double* x, const double* command);
  void read_points(const double* x, const Eigen::VectorXd& acceleration, Eigen::VectorXd& readings);
  void tilt_tangent(const double* x, const std::vector<ParameterId>& parameters, const Eigen::VectorXd& steps,
                    Eigen::MatrixXd& D);
  Structure make_structure() const;
  void apply_change(const StructureSlot& slot, Skeleton& skeleton, Eigen::VectorXd& inertia) const;
  void check_mass_matrix();

  effects::Motion motion(const ForceSlot& slot, const double* x) const;
  effects::Motion half_change(const ForceSlot& slot, const double* change) const;
  static std::vector<bool> sides_of_jumps(const ForceSlot& slot, const effects::Motion& at, const double* p);
  Reach reach_beside_jumps(const ForceSlot& slot, const effects::Motion& at, double most);
  const double* values(int effect) const { return values_[static_cast<std::size_t>(effect)].data(); }
  const double* on_ground(int effect) const { return on_ground_[static_cast<std::size_t>(effect)].data(); }
  void deliver_torques(const double* x, const double* command, double* xdot);
  void find_gear_loads(const double* x);
  void evaluate_rigid(const double* x, Structure& structure, Eigen::MatrixXd& M, Eigen::VectorXd& h);
  void make_loops();
  Eigen::VectorXd move_along_loops(const Eigen::MatrixXd& K, const Eigen::VectorXd& force,
                                   const Eigen::VectorXd& x);
  bool planar_base_is_bent() const;
  void hold_loops();
  void accelerate(const Eigen::VectorXd& Q, Eigen::VectorXd& acceleration) const;
  void accelerate_in_place(Eigen::MatrixXd& Q) const;
  Eigen::VectorXd accelerated(const Eigen::VectorXd& Q) const;
  void loop_tangent(const double* x, const Eigen::VectorXd& Q, const Eigen::VectorXd& a0);
  void rigid_at(const double* x);
  void factor_at(const double* x);
  double spectral_radius(const double* x);
  std::string coordinate_name(int full) const;
  void add_forces(const double* x, Eigen::VectorXd& Q, double* xdot);
  double actuator_chain(int motor, const double* x, double commanded, double* xdot) const;
  void rigid_tangent();
  void effect_tangent(const double* x, const double* change, Eigen::Ref<Eigen::MatrixXd> A);
  void force_tangent(const ForceSlot& slot, const double* x, const double* change,
                     Eigen::Ref<Eigen::MatrixXd> A);
  void parameter_tangent(const SampleMotion& sample, const double* x, const Eigen::MatrixXd& A,
                         ParameterId id, double step, bool refresh, Eigen::Ref<Eigen::VectorXd> column);
  void force_parameter_tangent(const ForceSlot& slot, const SampleMotion& sample, const double* x,
                               ParameterId id, const effects::Values& moved, double step,
                               Eigen::Ref<Eigen::VectorXd> column);
  void actuator_parameter_tangent(int motor, const ActuatorSlot& slot, const SampleMotion& sample,
                                  const double* x, const Eigen::MatrixXd& A, effects::Values moved,
                                  double step, Eigen::Ref<Eigen::VectorXd> column);
  void actuator_tangent(const double* x, const double* command, Eigen::Ref<Eigen::MatrixXd> A);
  Variant& variant_of(ParameterId id, double step);
  void structure_tangent(const double* x, ParameterId id, double step, bool refresh,
                         Eigen::Ref<Eigen::VectorXd> column);
  void gravity_tangent(const double* x, Variant& variant, bool refresh, Eigen::Ref<Eigen::VectorXd> column);
  void base_tangent(const SampleMotion& sample, ParameterId id, double step,
                    Eigen::Ref<Eigen::VectorXd> column);
  bool sits_at_base(int effect) const;

  Model model_;
  std::vector<effects::Values> values_;
  std::vector<effects::Values> on_ground_;  // the same for the ground's laws, with its changes
  std::vector<int> independent_;            // full coordinates that z are
  std::vector<int> charts_;                 // full coordinates that are a chart's pitch
  int n_tree_ = 0, n_ = 0, nz_ = 0, nx_ = 0, switch_count_ = 0;
  bool gear_friction_ = false;     // does a law feel what a gear passes on?
  Eigen::VectorXd motor_pulleys_;  // inertia that turns with each motor beside its rotor
  Eigen::MatrixXd S_, S_tree_;
  std::vector<std::vector<Entry>> S_rows_;  // of S_tree_
  Eigen::VectorXd q0_;
  std::vector<ForceSlot> forces_;
  std::vector<FootSlot> feet_;
  std::unique_ptr<LinkContacts> links_;  // null: none that has a law
  contact::Terrain terrain_;
  std::vector<std::vector<ActuatorSlot>> actuators_;  // by motor, in order of action
  std::vector<StructureSlot> structures_;
  std::vector<std::vector<SensorSlot>> sensor_effects_;
  std::vector<SwitchSlot> switch_effects_;
  std::vector<PointSlot> points_;
  std::vector<Line> motor_lines_;
  Eigen::MatrixXd output_map_, stretch_map_;
  Eigen::VectorXd output_offset_;
  Structure structure_;

  // Work space of the last evaluation.
  Eigen::VectorXd q_, v_, h_tree_, ground_, h_, Q_, torque_, acceleration_;
  Eigen::VectorXd gear_load_;  // what the motors' gears pass on; only where a law feels it
  Eigen::MatrixXd M_, M_tree_, SM_;
  Eigen::LLT<Eigen::MatrixXd> factor_;
  Eigen::VectorXd known_;  // positions and velocities that q_, v_, M_, h_ and the tree's kinematics belong to
  bool rigid_known_ = false, factored_ = false;
  Eigen::MatrixXd rigid_A_;
  TreeSlopes tree_slopes_;
  Eigen::MatrixXd slopes_;  // d(generalised force)/dx
  Eigen::MatrixXd foot_J_;
  Eigen::RowVectorXd foot_yaw_;
  Eigen::Matrix3Xd foot_V_;  // d(foot's velocity)/dz; without columns where it is not asked for
  Eigen::VectorXd foot_row_, moved_x_, up_, down_;
  std::vector<double> switch_values_;
  std::unique_ptr<LoopClosure> closure_;           // null: no loops
  Eigen::MatrixXd loop_J_, loop_Y_, loop_tree_J_;  // dphi/dz, M^-1 J' at the position of factor_
  Eigen::VectorXd loop_bias_;                      // (dJ/dt) w
  Eigen::LLT<Eigen::MatrixXd> loop_factor_;        // J M^-1 J'
  std::vector<Variant> variants_;  // perturbed structures, one for each structural parameter asked for
};

}  // namespace plumbline::model
