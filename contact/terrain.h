// The height of the ground under a foot: a floor with platforms.
#pragma once

#include <vector>

namespace plumbline::contact {

/// A stretch of raised (or sunken) level ground, in metres: from <= x < to along the direction of travel, and
/// as wide as the floor. `height` is that of its top over the same zero as the floor's, not over the floor.
struct Platform {
  double from = 0.0;
  double to = 0.0;
  double height = 0.0;
};

/// Level ground with steps. At an edge the height jumps: a foot that crosses one below the upper level is
/// suddenly deep in the ground and is thrown out; walls are not modelled. A run should stop at edges().
class Terrain {
 public:
  /// Level ground at 0 m.
  Terrain() = default;
  /// Throws std::invalid_argument when a number is not finite, a platform does not end after it begins, or
  /// two overlap (they may touch).
  explicit Terrain(double floor, std::vector<Platform> platforms = {});

  /// m, at x in m.
  double height_at(double x) const;

  double floor() const { return floor_; }
  /// In the order of x.
  const std::vector<Platform>& platforms() const { return platforms_; }
  /// Where the height may jump, ascending, m.
  std::vector<double> edges() const;

 private:
  double floor_ = 0.0;
  std::vector<Platform> platforms_;
};

}  // namespace plumbline::contact
