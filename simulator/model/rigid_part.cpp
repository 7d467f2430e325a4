#include "simulator/model/rigid_part.h"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace plumbline::model {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kPi = 3.14159265358979323846;

RigidPart of(double mass, double xx, double yy, double zz) {
  return {mass, Vector3d::Zero(), Vector3d(xx, yy, zz).asDiagonal()};
}

RigidPart ellipsoid(double a, double b, double c) {
  const double m = 4.0 / 3.0 * kPi * a * b * c;
  return of(m, m * (b * b + c * c) / 5.0, m * (a * a + c * c) / 5.0, m * (a * a + b * b) / 5.0);
}

RigidPart cylinder(double r, double h) {  // h: half length
  const double m = 2.0 * kPi * r * r * h;
  const double across = m * (3.0 * r * r + 4.0 * h * h) / 12.0;
  return of(m, across, across, 0.5 * m * r * r);
}

RigidPart capsule(double r, double h) {
  const RigidPart middle = cylinder(r, h);
  const double m = 4.0 / 3.0 * kPi * r * r * r;  // both ends
  const double from_flat = 3.0 / 8.0 * r;
  const double own = 0.4 * m * r * r - m * from_flat * from_flat;  // about the centres of the half spheres
  const double arm = h + from_flat;
  const double across = middle.inertia(0, 0) + own + m * arm * arm;
  return of(middle.mass + m, across, across, middle.inertia(2, 2) + 0.4 * m * r * r);
}

}  // namespace

std::optional<RigidPart> solid(const std::string& kind, const std::vector<double>& size) {
  const auto has = [&](std::size_t count) {
    return size.size() >= count &&
           std::all_of(size.begin(), size.begin() + static_cast<std::ptrdiff_t>(count),
                       [](double s) { return s > 0.0; });
  };
  if (kind == "sphere" && has(1)) {
    return ellipsoid(size[0], size[0], size[0]);
  }
  if (kind == "ellipsoid" && has(3)) {
    return ellipsoid(size[0], size[1], size[2]);
  }
  if (kind == "cylinder" && has(2)) {
    return cylinder(size[0], size[1]);
  }
  if (kind == "capsule" && has(2)) {
    return capsule(size[0], size[1]);
  }
  if (kind == "box" && has(3)) {
    const double m = 8.0 * size[0] * size[1] * size[2];
    const Vector3d s = Vector3d(size[0], size[1], size[2]).cwiseAbs2();
    return of(m, m * (s.y() + s.z()) / 3.0, m * (s.x() + s.z()) / 3.0, m * (s.x() + s.y()) / 3.0);
  }
  return std::nullopt;
}

RigidPart placed(const RigidPart& part, double mass, const Eigen::Isometry3d& X) {
  return {mass, X * part.com, mass / part.mass * (X.linear() * part.inertia * X.linear().transpose())};
}

Vector3d principal_moments(const Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

RigidPart together(const std::vector<RigidPart>& parts) {
  RigidPart whole;
  for (const RigidPart& part : parts) {
    whole.mass += part.mass;
    whole.com += part.mass * part.com;
  }
  if (!(whole.mass > 0.0)) {
    return {};
  }
  whole.com /= whole.mass;
  for (const RigidPart& part : parts) {
    const Vector3d d = part.com - whole.com;
    whole.inertia += part.inertia + part.mass * (d.squaredNorm() * Matrix3d::Identity() - d * d.transpose());
  }
  return whole;
}

}  // namespace plumbline::model
