// Feet on the ground: their forces on a model's independent coordinates and their slopes.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/contact_laws.h"
#include "simulator/model/coordinate_map.h"
#include "simulator/model/mechanism.h"
#include "simulator/model/model.h"
#include "simulator/model/plant_values.h"

namespace plumbline::model {

/// A foot that a ground presses.
struct FootSlot : ContactLaws {
  int foot = 0;             ///< index in the model
  int body = -1;            ///< in the mechanism's tree
  bool keeps_axes = false;  ///< its bristles lie in the world's axes, not in those of its link
};

/// The feet of a model that have a law of normal force. A foot is a point of a link, or a sphere about it;
/// what touches is the centre less the radius along the ground's normal, and meets the ground with the
/// velocity of the link's material point there. `tree` is that of the bodies, placed and moved; `values` are
/// those that change() leaves.
class GroundFeet {
 public:
  using Values = std::vector<effects::Values>;

  /// Model and map have to outlive the feet.
  GroundFeet(const Model& model, const CoordinateMap& map, contact::Terrain terrain);
  /// Takes feet and their laws; states are counted from next_state on.
  void take(const Values& values, int& next_state);
  /// Finds the feet's links; throws InputError for one that is fixed to the world.
  void find_links(const Mechanism& mechanism);
  /// ContactLaws::change of all.
  void change(const Values& stated, Values& changed, ContactLaws::Applied& applied);
  /// One of the slots alone, with or without its friction.
  GroundFeet only(const FootSlot& slot, bool with_drags) const;

  const contact::Terrain& terrain() const { return terrain_; }
  bool empty() const { return slots_.empty(); }
  const std::vector<FootSlot>& slots() const { return slots_; }
  /// Of one of the model's feet; null where no ground presses it.
  const FootSlot* slot_of(int foot) const;

  Touch touch(const FootSlot& slot, const TreeDynamics& tree) const;
  /// Sets the force; rates of states are written to xdot where it is given.
  void press(const FootSlot& slot, const double* x, const Values& values, Touch& touch, double* xdot) const;
  /// Q += J' F of all.
  void add_forces(const TreeDynamics& tree, const double* x, const Values& values, Eigen::VectorXd& Q,
                  double* xdot);
  /// Of all of the model's feet; one that no ground presses reads zeros.
  std::vector<Touch> touches(const TreeDynamics& tree, const double* x, const Values& values) const;
  /// What they store and what they take.
  void add_power(const TreeDynamics& tree, const double* x, const Values& values, Energetics& e) const;

  /// d(foot's velocity)/d(dz/dt), 3 x positions.
  const Eigen::MatrixXd& jacobian(const FootSlot& slot, const Touch& at, const TreeDynamics& tree);
  /// d(turn)/d(dz/dt), 3 x positions.
  Eigen::Matrix3Xd turn_jacobian(const FootSlot& slot, const TreeDynamics& tree) const;
  /// Adds the slopes of the forces to `slopes` (positions x states), those of the rates of bristles to A.
  /// With the change of x over a motion they are means on the way (Plant::tangent); null: where it stands.
  void add_slopes(const TreeDynamics& tree, const double* x, const Values& values, const double* change,
                  Eigen::MatrixXd& slopes, Eigen::Ref<Eigen::MatrixXd> A);

 private:
  /// At which slopes are taken, and where they go.
  struct SlopesAt {
    const TreeDynamics& tree;
    const Values& values;
    Eigen::MatrixXd& forces;
    Eigen::Ref<Eigen::MatrixXd>& rates;
  };
  double radius(const FootSlot& slot) const {
    return model_.feet[static_cast<std::size_t>(slot.foot)].radius;
  }
  Eigen::Vector3d below(const FootSlot& slot) const;
  void add_foot_slopes(const FootSlot& slot, const Touch& at, const Touch& half, SlopesAt& by);
  void add_moment_slopes(const FootSlot& slot, const Touch& at, const double* change, SlopesAt& by);
  void add_bristle_slopes(const FootSlot& slot, const Touch& at, SlopesAt& by);
  void find_turning(const FootSlot& slot, const Touch& at, const TreeDynamics& tree);
  void add_leverage_slopes(const FootSlot& slot, const Touch& at, const double* x, SlopesAt& by) const;

  const Model& model_;
  const CoordinateMap& map_;
  contact::Terrain terrain_;
  std::vector<FootSlot> slots_;

  // Work space of the foot that is looked at.
  Eigen::VectorXd on_joints_, row_;
  Eigen::MatrixXd J_;
  Eigen::RowVectorXd yaw_;
  Eigen::Matrix3Xd V_;  // d(foot's velocity)/dz; without columns where it is not asked for
  Eigen::VectorXd moved_x_, up_, down_;
};

}  // namespace plumbline::model
