// The two slides that carry a planar robot, and the arcs that a boom makes of them.
#pragma once

#include <optional>

#include "simulator/model/model.h"

namespace plumbline::model {

/// Places in Skeleton::joints of a joint that slides level on the world and of the one that slides up on it.
struct PlanarBase {
  int forward = 0, upward = 0;
};
std::optional<PlanarBase> planar_base(const Skeleton& skeleton);

/// Both ways as arcs of radius 1/|curvature| (1/m) about a point to the left of `forward` (above 0) or to
/// the right; the upward one leaves the vertical at `level` (m).
void bend_base(Skeleton& skeleton, const PlanarBase& base, double curvature, double level);

}  // namespace plumbline::model
