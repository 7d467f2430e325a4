// Contact between links of a model: its forces on the tree's joints and their slopes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "contact/shapes.h"
#include "simulator/model/contact_laws.h"
#include "simulator/model/mechanism.h"
#include "simulator/model/model.h"

namespace plumbline::model {

/// Where two links meet, or would, in the world's axes.
struct LinkTouch {
  int contact = 0;                                         ///< index in Model::contacts
  int first = 0;                                           ///< which of its ends is the first link here
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      ///< halfway between the surfaces, m
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();      ///< forward, left, normal (below)
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();      ///< of the first link less the second there, m/s
  double depth = 0.0;                                      ///< in each other when above 0, m
  Eigen::Vector3d force = Eigen::Vector3d::Zero();         ///< on the first link, N
  Eigen::Vector3d normal() const { return axes.col(2); }   ///< out of the second link
  double rate() const { return -normal().dot(velocity); }  ///< d(depth)/dt, m/s
};

/// Slopes of the forces of contact by what the tree's coordinates q, their rates v and the contacts' own
/// states s are, and of the rates of s.
struct LinkSlopes {
  Eigen::MatrixXd force_by_q, force_by_v;  ///< coordinates x coordinates
  Eigen::MatrixXd force_by_s;              ///< coordinates x states
  Eigen::MatrixXd rate_by_q, rate_by_v;    ///< states x coordinates
  Eigen::MatrixXd rate_by_s;               ///< states x states
};

/// The pairs of links that a model lists (Model::contacts) and gives a law of normal force. With J the
/// Jacobian of the first link's material point at the meeting point (contact/shapes.h) less that of the
/// second's, and F the force on the first link,
///   F = forward f_x + left f_y + normal f_n,   Q += J' F,
///   f_n and f_x, f_y the laws of depth, d(depth)/dt = -normal . J v and slip = (forward, left) . J v,
/// equal and opposite on both at one point: no momentum and no energy but the laws' own is made. `left` is
/// the second link's y axis along the surface (its z axis where y is across it), forward = left x normal.
/// Slopes are exact up to rounding of differences: those of the laws, as for feet, and of the meeting of the
/// two shapes; the tree's are closed forms. Numbers in x are seen through the indices of states alone.
class LinkContacts {
 public:
  /// Takes contacts and their laws; states are counted from next_state on.
  LinkContacts(const Model& model, const std::vector<effects::Values>& values, int& next_state);

  bool empty() const { return slots_.empty(); }
  /// Places where shapes meet: a contact may have several.
  int points() const { return static_cast<int>(slots_.size()); }
  int first_state() const { return first_state_; }
  int states() const { return states_; }
  /// Does an effect, by its index in the model, belong to any of them?
  bool answers_to(int effect) const;
  const ContactLaws& laws(int point) const { return slots_[static_cast<std::size_t>(point)]; }
  /// " (3)" of the third point of its contact; empty where it has one only.
  std::string number_of(int point) const;

  /// Finds the links in the tree; a link that is fixed to the world stays where the skeleton has it.
  void find_links(const Model& model, const Mechanism& mechanism);
  /// ContactLaws::change of all.
  void change(const std::vector<effects::Values>& stated, std::vector<effects::Values>& changed,
              ContactLaws::Applied& applied);
  /// The same with one point alone, with or without its friction.
  LinkContacts only(int point, bool with_drags) const;

  /// At the tree's positions and velocities; `values` are those of change().
  LinkTouch touch(int point, const TreeDynamics& tree) const;
  /// Sets the force; rates of states are written to xdot where it is given.
  void press(int point, const double* x, const std::vector<effects::Values>& values, LinkTouch& touch,
             double* xdot) const;
  /// Q += J' F of all, Q on the tree's coordinates.
  void add_forces(const TreeDynamics& tree, const double* x, const std::vector<effects::Values>& values,
                  Eigen::VectorXd& Q, double* xdot) const;

  /// Changes of q and v over a motion make slopes of the laws their means on the way (Plant::tangent); zero:
  /// where it stands. x has `size` numbers.
  void find_slopes(const TreeDynamics& tree, const double* x, Eigen::Index size,
                   const std::vector<effects::Values>& values, const Eigen::VectorXd& dq,
                   const Eigen::VectorXd& dv, LinkSlopes& slopes) const;

 private:
  struct Side {
    int link = -1;  // in the skeleton; -1: the world
    int body = -1;  // in the tree; -1: it stays at X_W
    Eigen::Isometry3d X_W = Eigen::Isometry3d::Identity();
  };
  struct Slot : ContactLaws {
    int contact = 0;
    int end = 0;  // of the contact, that is the first link
    Side first, second;
    contact::Round part;   // of the first, in its frame
    contact::Shape shape;  // of the second, in its frame
  };
  struct Turning;    // what shifts and turns with the tree's coordinates
  struct LawSlopes;  // of the laws alone

  void take_contact(const Model& model, int contact, const std::vector<effects::Values>& values,
                    int& next_state);
  static Eigen::Isometry3d pose_of(const Side& side, const TreeDynamics& tree);
  static LinkTouch meet(const Slot& slot, const Eigen::Isometry3d& first, const Eigen::Isometry3d& second);
  static void add_turning(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at, bool of_first,
                          Turning& turn);
  static Turning carried(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at);
  static void find_turning(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at, Turning& turn);
  LawSlopes law_slopes(const Slot& slot, const Eigen::Vector4d& at, const Eigen::Vector4d& half,
                       Eigen::VectorXd& x, const std::vector<effects::Values>& values) const;
  static void add_slopes(const Slot& slot, const TreeDynamics& tree, const LinkTouch& at, const Turning& turn,
                         const LawSlopes& laws, LinkSlopes& slopes);

  std::vector<Slot> slots_;
  int first_state_ = 0, states_ = 0;
};

}  // namespace plumbline::model
