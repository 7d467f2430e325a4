// Meshes from files, through assimp: OBJ, STL, DAE, glTF and what else it reads.
#pragma once

#include <string>

#include "simulator/mesh/mesh.h"

namespace plumbline::mesh {

/// A mesh, or why there is none that can be used.
struct MeshFile {
  Mesh mesh;
  std::string problem;  ///< "FILE: found ..., expected ..."; empty when the mesh is good
};

/// All triangles of the file in one frame, its axes as they are (an up direction that it states is not turned
/// to another), points at the same place joined, times `scale`, which makes metres of the file's units axis
/// by axis. Problems, one line each: no such file, nothing that assimp can read, no triangle with an area, a
/// coordinate that is no number, more triangles than can be drawn (2 million), a size that speaks of a wrong
/// unit (above 20 m or below 0.1 mm).
MeshFile read_mesh(const std::string& path, const Eigen::Vector3d& scale);

}  // namespace plumbline::mesh
