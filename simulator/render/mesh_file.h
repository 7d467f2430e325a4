// Meshes from files, through assimp: OBJ, STL, DAE, glTF and what else it reads.
#pragma once

#include <string>

#include "simulator/model/visual.h"
#include "simulator/render/mesh.h"

namespace plumbline::render {

/// A mesh, or why there is none that can be used.
struct MeshFile {
  Mesh mesh;
  std::string problem;  ///< "FILE: found ..., expected ..."; empty when the mesh is good
};

/// All triangles of the file in one frame, its axes as they are (an up direction that it states is not turned
/// to another), points at the same place joined, times shape.scale. Problems, one
/// line each: no such file, nothing that assimp can read, no triangle with an area, a coordinate that is no
/// number, more triangles than can be drawn (2 million), a size that speaks of a wrong unit (above 20 m or
/// below 0.1 mm).
MeshFile read_mesh(const model::MeshShape& shape);

}  // namespace plumbline::render
