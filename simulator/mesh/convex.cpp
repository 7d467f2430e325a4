#include "simulator/mesh/convex.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace plumbline::mesh {
namespace {

double signed_volume(const Mesh& mesh) {
  double volume = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += mesh.points[static_cast<std::size_t>(a)].dot(
                  mesh.points[static_cast<std::size_t>(b)].cross(mesh.points[static_cast<std::size_t>(c)])) /
              6.0;
  }
  return volume;
}

}  // namespace

double largest_dent(const Mesh& mesh) {
  const double outward = signed_volume(mesh) < 0.0 ? -1.0 : 1.0;
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
