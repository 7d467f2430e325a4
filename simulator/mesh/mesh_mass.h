// Volume, centre and inertia of what a closed mesh encloses, and whether that is convex.
#pragma once

#include <Eigen/Core>

#include "simulator/mesh/mesh.h"

namespace plumbline::mesh {

/// Of a solid with density 1.
struct SolidProperties {
  bool faces_inward = false;                          ///< its triangles are clockwise seen from outside
  double volume = 0.0;                                ///< m^3
  Eigen::Vector3d center = Eigen::Vector3d::Zero();   ///< of mass, in the mesh's frame, m
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the centre, per density, m^5
};

/// True when every edge belongs to two triangles that run along it in opposite directions (as often one way
/// as the other where several parts touch).
bool is_closed(const Mesh& mesh);

/// Each triangle and the origin span a tetrahedron; the signed sums are the integrals of 1, r and r r' over
/// the solid (divergence theorem): with J = det[a b c], volume J/6, first moment J/24 (a + b + c), second
/// moments J/120 (sum over the corners of p p' + s s'), s = a + b + c.
/// Source: F. Tonon, "Explicit exact formulas for the 3-D tetrahedron inertia tensor in terms of its vertex
/// coordinates", J. Mathematics and Statistics 1 (2005). Meaningful only when is_closed(). A surface that
/// faces inward gives the same solid.
SolidProperties solid_properties(const Mesh& mesh);

/// How far a point of the mesh lies in front of the plane of one of its triangles at most, m: 0 of a convex
/// solid, but for rounding. A surface that faces inward is taken for the solid that it encloses. Meaningful
/// only when is_closed(); takes points times triangles.
double largest_dent(const Mesh& mesh);

}  // namespace plumbline::mesh
