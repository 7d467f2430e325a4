// Closed surfaces whose volume and inertia textbooks give.
#pragma once

#include <cmath>
#include <map>
#include <utility>

#include "simulator/mesh/mesh.h"

namespace plumbline::mesh {

/// One corner at `low`, the opposite one at `high`.
inline Mesh box_mesh(const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
  Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.points.emplace_back((k & 1) != 0 ? high.x() : low.x(), (k & 2) != 0 ? high.y() : low.y(),
                             (k & 4) != 0 ? high.z() : low.z());
  }
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

inline Mesh tetrahedron_mesh(const std::array<Eigen::Vector3d, 4>& corners) {
  Mesh mesh;
  mesh.points.assign(corners.begin(), corners.end());
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  return mesh;
}

/// An octahedron whose triangles are cut into four, `times` times, and pushed out to the sphere.
inline Mesh sphere_mesh(double radius, int times) {
  Mesh mesh;
  mesh.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int round = 0; round < times; ++round) {
    std::map<std::pair<int, int>, int> middles;
    const auto middle = [&](int a, int b) {
      const auto [it, is_new] =
          middles.insert({{std::min(a, b), std::max(a, b)}, static_cast<int>(mesh.points.size())});
      if (is_new) {
        const Eigen::Vector3d sum =
            mesh.points[static_cast<std::size_t>(a)] + mesh.points[static_cast<std::size_t>(b)];
        mesh.points.emplace_back(sum.normalized());
      }
      return it->second;
    };
    std::vector<std::array<int, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const int ab = middle(a, b);
      const int bc = middle(b, c);
      const int ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.triangles = finer;
  }
  for (Eigen::Vector3d& point : mesh.points) {
    point *= radius;
  }
  return mesh;
}

}  // namespace plumbline::mesh
