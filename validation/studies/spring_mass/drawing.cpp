#include "validation/studies/spring_mass/drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::spring_mass {
namespace {

constexpr double left = 70.0, right = 620.0, top = 40.0, bottom = 430.0;

/// A range of one axis, a little wider than the data.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  void widen() {
    if (!(high >= low)) {
      low = 0.0;
      high = 1.0;
    }
    const double margin = high > low ? 0.05 * (high - low) : 0.5;
    low -= margin;
    high += margin;
  }
};

double tick_of(const Range& range) {
  const double rough = (range.high - range.low) / 6.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) {
      return factor * power;
    }
  }
  return 10.0 * power;
}

}  // namespace

std::string Drawing::svg() const {
  Range x, y;
  for (const Marks& one : marks) {
    for (const Eigen::Vector2d& point : one.points) {
      x.add(point.x());
      y.add(point.y());
    }
  }
  x.widen();
  y.widen();
  if (same_scale) {
    const double scale = std::max((x.high - x.low) / (right - left), (y.high - y.low) / (bottom - top));
    const auto stretch = [](Range& range, double width) {
      const double middle = 0.5 * (range.low + range.high);
      range.low = middle - 0.5 * width;
      range.high = middle + 0.5 * width;
    };
    stretch(x, scale * (right - left));
    stretch(y, scale * (bottom - top));
  }
  const auto px = [&](double value) { return left + (value - x.low) / (x.high - x.low) * (right - left); };
  const auto py = [&](double value) { return bottom - (value - y.low) / (y.high - y.low) * (bottom - top); };
  std::string text = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 480\" font-family=\"sans-serif\" "
      "font-size=\"13\">\n<rect width=\"640\" height=\"480\" fill=\"white\"/>\n"
      "<text x=\"345\" y=\"22\" text-anchor=\"middle\" font-size=\"15\">{}</text>\n",
      title);
  const double step_x = tick_of(x), step_y = tick_of(y);
  for (double v = std::ceil(x.low / step_x) * step_x; v <= x.high; v += step_x) {
    text += fmt::format(
        "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/><text x=\"{0:.1f}\" "
        "y=\"448\" text-anchor=\"middle\">{3:.4g}</text>\n",
        px(v), top, bottom, std::abs(v) < 1e-9 * step_x ? 0.0 : v);
  }
  for (double v = std::ceil(y.low / step_y) * step_y; v <= y.high; v += step_y) {
    text += fmt::format(
        "<line x1=\"{1}\" y1=\"{0:.1f}\" x2=\"{2}\" y2=\"{0:.1f}\" stroke=\"#ddd\"/><text x=\"64\" "
        "y=\"{4:.1f}\" text-anchor=\"end\">{3:.4g}</text>\n",
        py(v), left, right, std::abs(v) < 1e-9 * step_y ? 0.0 : v, py(v) + 4.0);
  }
  text += fmt::format(
      "<text x=\"345\" y=\"470\" text-anchor=\"middle\">{}</text>\n<text x=\"18\" y=\"235\" "
      "text-anchor=\"middle\" transform=\"rotate(-90 18 235)\">{}</text>\n",
      across, up);
  double key = 56.0;
  for (const Marks& one : marks) {
    if (one.joined && !one.points.empty()) {
      text += fmt::format("<polyline fill=\"none\" stroke=\"{}\" points=\"", one.colour);
      for (const Eigen::Vector2d& point : one.points) {
        text += fmt::format("{:.1f},{:.1f} ", px(point.x()), py(point.y()));
      }
      text += "\"/>\n";
    }
    for (const Eigen::Vector2d& point : one.points) {
      if (!one.joined) {
        text += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"{}\"/>\n", px(point.x()),
                            py(point.y()), one.colour);
      }
    }
    text += fmt::format("<text x=\"80\" y=\"{}\" fill=\"{}\">{}</text>\n", key, one.colour, one.name);
    key += 16.0;
  }
  return text + "</svg>\n";
}

Drawing seen_from_above(const Trail& trail) {
  Marks path{"mass", "#2a5caa", {}, true}, feet{"foot points", "#c0392b", {}, false};
  Marks ways{"way-points", "#1e8449", trail.waypoints, false};
  for (const Eigen::Vector3d& at : trail.path) {
    path.points.emplace_back(at.head<2>());
  }
  for (const TrailStep& one : trail.steps) {
    feet.points.emplace_back(one.foot_x, one.foot_y);
  }
  return {"Way-point navigation, seen from above", "x [m]", "y [m]", {path, feet, ways}, true};
}

Drawing apex_errors(const Trail& trail) {
  Marks marks{"every step", "#2a5caa", {}, false};
  for (const TrailStep& one : trail.steps) {
    marks.points.emplace_back(100.0 * one.ground, 100.0 * one.apex_error);
  }
  return {
      "Error of the next apex", "height of the ground [cm]", "next apex minus target [cm]", {marks}, false};
}

Drawing deflection_errors(const Trail& trail) {
  Marks reached{"wanted turn can be reached", "#2a5caa", {}, false};
  Marks clipped{"nearest turn taken", "#c0392b", {}, false};
  for (const TrailStep& one : trail.steps) {
    (one.clipped ? clipped : reached).points.emplace_back(100.0 * one.ground, one.deflection_error / degree);
  }
  return {"Error of the deflection",
          "height of the ground [cm]",
          "deflection minus wanted [deg]",
          {reached, clipped},
          false};
}

Drawing return_map(const Trail& trail, double target) {
  Marks marks{"every step", "#2a5caa", {}, false};
  double ground = 0.0;
  for (const TrailStep& one : trail.steps) {
    marks.points.emplace_back(one.apex - ground, target + one.apex_error);
    ground = one.ground;
  }
  return {"Apex return map", "apex [m]", "next apex [m]", {marks}, false};
}

}  // namespace plumbline::spring_mass
