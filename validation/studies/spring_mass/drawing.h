// Plain drawings of a trail as SVG text: points and lines over labelled axes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "validation/studies/spring_mass/trail.h"

namespace plumbline::spring_mass {

/// One set of points: dots, or joined by a line.
struct Marks {
  std::string name, colour;
  std::vector<Eigen::Vector2d> points;
  bool joined = false;
};

struct Drawing {
  std::string title, across, up;  ///< titles of figure and axes, with units
  std::vector<Marks> marks;
  bool same_scale = false;  ///< a metre across is as long as a metre up
  /// 640 x 480 user units; ticks at 1, 2 or 5 times a power of ten.
  std::string svg() const;
};

/// Seen from above: path, way-points, foot points (figure 3.5A).
Drawing seen_from_above(const Trail& trail);
/// Error of the next apex over the height of the ground that the foot met (figure 3.5C), in cm.
Drawing apex_errors(const Trail& trail);
/// The same of the deflection (figure 3.5D), in degrees; clipped turns apart.
Drawing deflection_errors(const Trail& trail);
/// Next apex over apex, both above the ground under them (figure 3.8D), in m.
Drawing return_map(const Trail& trail, double target);

}  // namespace plumbline::spring_mass
