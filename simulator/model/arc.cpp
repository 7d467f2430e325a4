#include "simulator/model/arc.h"

#include <cmath>

namespace plumbline::model {
namespace {

/// sin(x)/x
double sinc(double x) { return std::abs(x) < 1e-8 ? 1.0 : std::sin(x) / x; }

}  // namespace

Eigen::Isometry3d slid(const Eigen::Vector3d& axis, const Arc& arc, double q) {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (!arc.is_bent()) {
    X.translation() = q * axis;
    return X;
  }
  const double curvature = arc.turn.norm();
  const double s = q - arc.straight;
  const double half = s * sinc(0.5 * curvature * s);  // (1 - cos(a))/w^2 = half^2/2, also for the smallest w
  X.linear() = Eigen::AngleAxisd(curvature * s, arc.turn / curvature).toRotationMatrix();
  X.translation() =
      (arc.straight + s * sinc(curvature * s)) * axis + 0.5 * half * half * arc.turn.cross(axis);
  return X;
}

Eigen::Vector3d centre_of(const Eigen::Vector3d& axis, const Arc& arc) {
  return arc.straight * axis + arc.turn.cross(axis) / arc.turn.squaredNorm();
}

}  // namespace plumbline::model
