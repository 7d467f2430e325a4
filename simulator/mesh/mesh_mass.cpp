#include "simulator/mesh/mesh_mass.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <map>
#include <utility>

namespace plumbline::mesh {

bool is_closed(const Mesh& mesh) {
  std::map<std::pair<int, int>, int> balance;  // of each edge, up less down
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = triangle[k];
      const int to = triangle[(k + 1) % 3];
      if (from != to) {
        balance[{std::min(from, to), std::max(from, to)}] += from < to ? 1 : -1;
      }
    }
  }
  for (const auto& [edge, difference] : balance) {
    if (difference != 0) {
      return false;
    }
  }
  return !balance.empty();
}

SolidProperties solid_properties(const Mesh& mesh) {
  double volume = 0.0;
  Eigen::Vector3d first = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second = Eigen::Matrix3d::Zero();
  // About a point of the mesh: far from the origin the sums would lose digits.
  const Eigen::Vector3d base = mesh.points.empty() ? Eigen::Vector3d::Zero() : mesh.points.front();
  for (const auto& triangle : mesh.triangles) {
    Eigen::Matrix3d corners;
    for (int k = 0; k < 3; ++k) {
      corners.col(k) = mesh.points[static_cast<std::size_t>(triangle[static_cast<std::size_t>(k)])] - base;
    }
    const double J = corners.determinant();
    const Eigen::Vector3d sum = corners.rowwise().sum();
    volume += J / 6.0;
    first += J / 24.0 * sum;
    second += J / 120.0 * (corners * corners.transpose() + sum * sum.transpose());
  }
  SolidProperties solid;
  if (volume == 0.0) {
    return solid;
  }
  const double sign = volume < 0.0 ? -1.0 : 1.0;
  solid.faces_inward = volume < 0.0;
  solid.volume = sign * volume;
  const Eigen::Vector3d center = first / volume;
  const Eigen::Matrix3d central = sign * second - solid.volume * center * center.transpose();
  solid.inertia = central.trace() * Eigen::Matrix3d::Identity() - central;
  solid.center = base + center;
  return solid;
}

double largest_dent(const Mesh& mesh) {
  const double outward = solid_properties(mesh).faces_inward ? -1.0 : 1.0;
  double dent = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d& corner = mesh.points[static_cast<std::size_t>(a)];
    const Eigen::Vector3d normal = (mesh.points[static_cast<std::size_t>(b)] - corner)
                                       .cross(mesh.points[static_cast<std::size_t>(c)] - corner);
    if (normal.norm() > 0.0) {
      for (const Eigen::Vector3d& point : mesh.points) {
        dent = std::max(dent, outward * normal.normalized().dot(point - corner));
      }
    }
  }
  return dent;
}

}  // namespace plumbline::mesh
