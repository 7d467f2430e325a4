// Triangles as numbers.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace plumbline::mesh {

/// Points in m; each triangle names three of them, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<int, 3>> triangles;
};

}  // namespace plumbline::mesh
