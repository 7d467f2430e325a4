// A plant on rigid ground: pinned feet instead of laws of the ground, and the blow of a foot that comes down.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/model/foot_kinematics.h"
#include "simulator/model/plant.h"
#include "simulator/rigid/constraints.h"

namespace plumbline::model {

/// What is held: feet (indices in Model::feet) in all three directions, and coordinates (joints, coordinates,
/// motors, pulleys) where they are: a spring's pulley on its stop.
struct Holds {
  std::vector<int> feet;
  std::vector<std::string> coordinates;
};

/// M dw/dt = Q + J' lambda with the held velocities zero (rigid/constraints.h). The plant's own effects act
/// as they always do; a model for rigid ground has no effect at its feet. Not thread-safe: one object for
/// each thread.
class RigidContact {
 public:
  explicit RigidContact(Plant& plant);

  /// Holds feet and coordinates where they are at x, until the next call. Throws InputError for an unknown
  /// name and std::out_of_range for an unknown foot.
  void hold(const Holds& holds, const double* x);
  const Holds& holds() const { return holds_; }
  FootKinematics& kinematics() { return kinematics_; }

  /// Time derivative of the state, as Plant::rate, and the reactions.
  void rate(const double* x, const double* command, double* xdot);
  /// Of the ground on a held foot at the last rate(), in the world's axes, N; `foot` counts within
  /// holds().feet.
  Eigen::Vector3d foot_force(int foot) const;
  /// On a held coordinate at the last rate(), N m or N; counts within holds().coordinates.
  double holding_force(int coordinate) const;

  /// Moves x onto what is held: positions by the smallest move in the mass matrix, then velocities as by a
  /// blow. Returns how far it was off before (largest of m and rad).
  double project(double* x);

  struct Blow {
    std::vector<Eigen::Vector3d> feet;  ///< impulse of the ground on each of the feet, N s
    Eigen::VectorXd coordinates;        ///< on each of the coordinates, N m s or N s
    double lost = 0.0;                  ///< kinetic energy, J
  };
  /// The rigid impact at x: velocities after it are such that none of `caught` moves
  /// (rigid::Constraints::strike); they replace those of x. What is held now is let go and plays no part: a
  /// foot that is to stay is named again.
  Blow strike(const Holds& caught, double* x);

 private:
  Eigen::MatrixXd rows_of(const Holds& holds, const double* x, Eigen::VectorXd* bias);
  Eigen::VectorXd error(const double* x);
  const Eigen::MatrixXd& mass_matrix(const double* x);

  Plant& plant_;
  FootKinematics kinematics_;
  Holds holds_;
  std::vector<Eigen::Vector3d> where_;  // each foot is held
  Eigen::VectorXd at_;                  // each coordinate is held
  std::vector<Eigen::RowVectorXd> rows_;
  rigid::Constraints constraints_;
  Eigen::VectorXd reaction_, bias_, rate_, no_command_;
};

}  // namespace plumbline::model
