// A boom that carries the robot round a tower.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// A robot that is planar without it hangs at a boom of length 1/|curvature|, level at height `level`; the
/// tower stands to the left above curvature 0, to the right below. The base's coordinates x and z become the
/// arcs that the boom's end runs through:
///   yaw = curvature*x, roll = -curvature*(z - level)   [rad; curvature 1/m, level m]
///   hip = (cos(r)*sin(yaw), 1 - cos(r)*cos(yaw), sin(r))/curvature + (0, 0, level), r = curvature*(z -
///   level)
/// At curvature 0 the base slides straight. The boom's own inertia and weight are the model's.
/// Source: geometry; Park et al., Figure 2 and Table VI (2.25 m).
class Boom final : public StructureLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;
  bool is_null(const double* p) const override;

  StructureChange change(const double* p) const override;
};

}  // namespace plumbline::effects
