#include "validation/batch/value_drawing.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/report/page.h"

namespace plumbline::batch {
namespace {

using nlohmann::json;

constexpr double kWidth = 380.0, kHeight = 150.0;  // pixels
constexpr double kLeft = 62.0, kRight = 10.0, kTop = 8.0, kBottom = 22.0;

/// From numbers to pixels along one axis.
struct Axis {
  double from = 0.0, to = 1.0;    // numbers
  double begin = 0.0, end = 1.0;  // pixels
  double at(double number) const { return begin + (number - from) / (to - from) * (end - begin); }
};

void widen(double share, Axis& axis) {
  const double size = std::max(std::abs(axis.from), std::abs(axis.to));
  const double margin = axis.to > axis.from ? share * (axis.to - axis.from) : (size > 0.0 ? 0.1 * size : 1.0);
  axis.from -= margin;
  axis.to += margin;
}

bool is_over_days(const ValueOverRows& value) {
  return std::all_of(value.rows.begin(), value.rows.end(), [](const RowValue& one) { return one.day; });
}

Axis across(const ValueOverRows& value, bool over_days) {
  Axis axis{INFINITY, -INFINITY, kLeft, kWidth - kRight};
  for (std::size_t i = 0; i < value.rows.size(); ++i) {
    const double x = over_days ? *value.rows[i].day : static_cast<double>(i + 1);
    axis.from = std::min(axis.from, x);
    axis.to = std::max(axis.to, x);
  }
  widen(0.06, axis);
  return axis;
}

Axis upward(const ValueOverRows& value) {
  Axis axis{value.lower, value.upper, kHeight - kBottom, kTop};
  for (const RowValue& one : value.rows) {
    axis.from = std::min({axis.from, one.lower, one.value});
    axis.to = std::max({axis.to, one.upper, one.value});
  }
  widen(0.08, axis);
  return axis;
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour, double width) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"{}\" stroke-width=\"{:g}\"/>",
      x1, y1, x2, y2, colour, width);
}

std::string text(double x, double y, const char* anchor, const std::string& words) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", x, y, anchor,
                     validation::html_text(words));
}

/// The mean and its interval, behind everything else, and the frame with the numbers at its ends.
std::string frame_of(const ValueOverRows& value, const Axis& y) {
  const double right = kWidth - kRight;
  std::string svg = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"#e9e9e9\"/>", kLeft,
      y.at(value.upper), right - kLeft, std::max(0.0, y.at(value.lower) - y.at(value.upper)));
  svg += line(kLeft, y.at(value.mean), right, y.at(value.mean), "#999", 1.0);
  svg += line(kLeft, kTop, kLeft, kHeight - kBottom, "#888", 1.0);
  svg += line(kLeft, kHeight - kBottom, right, kHeight - kBottom, "#888", 1.0);
  for (const double share : {0.1, 0.5, 0.9}) {
    const double number = y.from + share * (y.to - y.from);
    svg += line(kLeft - 3.0, y.at(number), kLeft, y.at(number), "#888", 1.0);
    svg += text(kLeft - 6.0, y.at(number) + 4.0, "end", fmt::format("{:.3g}", number));
  }
  return svg;
}

/// The first and the last day, or the first and the last row.
std::string ends_of(const ValueOverRows& value, const std::vector<json>& rows, bool over_days,
                    const Axis& x) {
  const auto by_day = [](const RowValue& one, const RowValue& other) { return *one.day < *other.day; };
  const auto ends = over_days ? std::minmax_element(value.rows.begin(), value.rows.end(), by_day)
                              : std::pair(value.rows.begin(), value.rows.end() - 1);
  const char* key = over_days ? "day" : "label";
  const std::string first = rows[ends.first->row].value(key, ""),
                    last = rows[ends.second->row].value(key, "");
  const double y = kHeight - 7.0;
  if (first == last) {
    return text(x.at(0.5 * (x.from + x.to)), y, "middle", first);
  }
  return text(kLeft, y, "start", first) + text(kWidth - kRight, y, "end", last);
}

/// The lines of what drifts.
std::string drifts_of(const ValueOverRows& value, const Axis& x, const Axis& y, const RobotColours& colours) {
  std::string svg;
  for (const Drift& drift : value.drifts) {
    if (!drift.drifts()) {
      continue;
    }
    double first = INFINITY, last = -INFINITY;
    for (const RowValue& one : value.rows) {
      if (one.robot == drift.robot && one.day) {
        first = std::min(first, *one.day);
        last = std::max(last, *one.day);
      }
    }
    const auto height = [&](double day) { return y.at(drift.mean + drift.slope * (day - drift.mean_day)); };
    svg += line(x.at(first), height(first), x.at(last), height(last), colours.of(drift.robot), 1.5);
  }
  return svg;
}

}  // namespace

RobotColours::RobotColours(const std::vector<json>& rows) {
  for (const json& row : rows) {
    const std::string robot = row.value("robot", "");
    if (std::find(names_.begin(), names_.end(), robot) == names_.end()) {
      names_.push_back(robot);
    }
  }
}

std::string RobotColours::of(const std::string& robot) const {
  constexpr std::array<const char*, 7> kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                "#e69f00", "#56b4e9", "#000000"};
  const auto index = std::find(names_.begin(), names_.end(), robot) - names_.begin();
  return kColours[static_cast<std::size_t>(index) % kColours.size()];
}

std::string drawing_of(const ValueOverRows& value, const std::vector<json>& rows,
                       const RobotColours& colours) {
  const bool over_days = is_over_days(value);
  const Axis x = across(value, over_days), y = upward(value);
  std::string svg = fmt::format(
      "<svg width=\"{0:g}\" height=\"{1:g}\" viewBox=\"0 0 {0:g} {1:g}\" role=\"img\" aria-label=\"{2}\">",
      kWidth, kHeight, validation::html_text(value.name));
  svg += frame_of(value, y) + ends_of(value, rows, over_days, x) + drifts_of(value, x, y, colours);
  for (std::size_t i = 0; i < value.rows.size(); ++i) {
    const RowValue& one = value.rows[i];
    const double at = x.at(over_days ? *one.day : static_cast<double>(i + 1));
    const std::string colour = colours.of(one.robot);
    svg += line(at, y.at(one.lower), at, y.at(one.upper), colour, 1.5);
    svg += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3.5\" fill=\"{}\"><title>{}: {:.6g}</title></circle>", at,
        y.at(one.value), colour, validation::html_text(rows[one.row].value("label", "")), one.value);
  }
  return svg + "</svg>";
}

}  // namespace plumbline::batch
