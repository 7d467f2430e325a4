// Where two simple shapes meet: points, spheres, capsules, boxes and planes. Geometry only.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <string>
#include <variant>
#include <vector>

namespace plumbline::contact {

/// All points within `radius` of the straight line from one point to the other, m: a capsule; a sphere where
/// both are the same; with radius 0 a point.
struct Round {
  Eigen::Vector3d from = Eigen::Vector3d::Zero();
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  double radius = 0.0;
  bool is_ball() const { return from == to; }
};

struct Box {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< of its centre and edges
  Eigen::Vector3d half = Eigen::Vector3d::Zero();          ///< half of each edge, m
};

/// A half-space: all behind the plane.
struct Plane {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
};

using Shape = std::variant<Round, Box, Plane>;

/// "point", "sphere", "capsule", "box", "plane"
std::string name_of(const Shape& shape);

/// How a first shape meets a second one.
struct Meeting {
  /// Halfway between the surfaces, along the normal, m. Both shapes' material is asked here.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< out of the second shape, unit
  double depth = 0.0;                                 ///< of the first in the second, m; under 0: apart
};

/// With c the point on the first shape's line that is nearest to the second shape, s that shape's surface
/// point nearest to c and n the unit vector from s to c (inside a box: out of its nearest face),
///   depth = radius - n . (c - s),  d(depth)/dt = -n . (velocity of the first - velocity of the second),
/// exact at any point of the line along n, for s and c move across it. Smooth but where the nearest point
/// jumps: equal centres, a centre that is as far from two faces inside a box, capsules that lie along each
/// other (they meet in the middle of what they share). All in one frame. `first` is a ball unless `second`
/// is round, too.
/// Source: closest points of segments and boxes, C. Ericson, Real-Time Collision Detection, Morgan Kaufmann
/// 2005, 5.1.3 and 5.1.9.
Meeting meet(const Round& first, const Shape& second);

/// The parts of a shape with which alone it can meet the other one: a ball is one; so is a capsule beside
/// what is round, and it is its two ends on a plane; a box is its corners on a plane. Empty: such a pair is
/// not known in this order (perhaps in the other), or two bare points.
std::vector<Round> parts_that_meet(const Shape& one, const Shape& other);

/// The same shape where its frame is at the pose.
Round moved(const Eigen::Isometry3d& pose, const Round& round);

}  // namespace plumbline::contact
