// Whether a closed mesh is convex.
#pragma once

#include "simulator/mesh/mesh.h"

namespace plumbline::mesh {

/// How far a point of the mesh lies in front of the plane of one of its triangles at most, m: 0 of a convex
/// solid, but for rounding. A surface that faces inward is taken for the solid that it encloses. Meaningful
/// only when is_closed(); takes points times triangles.
double largest_dent(const Mesh& mesh);

}  // namespace plumbline::mesh
