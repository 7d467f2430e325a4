// Mass properties of rigid parts: the solids that files describe, and parts put together.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::model {

/// Mass, centre of mass and inertia about it.
struct RigidPart {
  double mass = 0.0;
  Eigen::Vector3d com = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

/// A solid of density 1 about its own centre, its length along z; sizes as MJCF gives them: sphere (radius),
/// capsule and cylinder (radius, half length), box and ellipsoid (three half axes). Nothing when the kind is
/// another one or a size is missing or not above zero. Closed forms; a capsule is a cylinder between two
/// half spheres (the parallel axis theorem with 3/8 r from the flat side to a half sphere's centre).
std::optional<RigidPart> solid(const std::string& kind, const std::vector<double>& size);

/// With that mass, in the frame in which X is its pose.
RigidPart placed(const RigidPart& part, double mass, const Eigen::Isometry3d& X);

/// Principal moments of an inertia, the smallest first.
Eigen::Vector3d principal_moments(const Eigen::Matrix3d& inertia);

/// All parts as one rigid body.
RigidPart together(const std::vector<RigidPart>& parts);

}  // namespace plumbline::model
