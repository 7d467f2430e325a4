// A slide whose way is an arc.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace plumbline::model {

/// What slides turns by `turn` for each metre: its way is an arc of radius 1/|turn|. Straight where `turn` is
/// zero.
struct Arc {
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< across the axis, rad/m
  double straight = 0.0;                           ///< position at which the arc leaves the axis, m

  bool is_bent() const { return !turn.isZero(0.0); }
};

/// How a body that slides along a unit axis by q has moved, in the frame of axis and arc; w = turn,
/// s = q - straight:
///   R = exp([w] s),  p = straight*axis + sin(|w| s)/|w| axis + (1 - cos(|w| s))/|w|^2 w x axis
Eigen::Isometry3d slid(const Eigen::Vector3d& axis, const Arc& arc, double q);

/// The point about which it turns, where it is bent.
Eigen::Vector3d centre_of(const Eigen::Vector3d& axis, const Arc& arc);

}  // namespace plumbline::model
