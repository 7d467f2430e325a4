#include "simulator/render/key.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "simulator/trace/number_text.h"

namespace plumbline::render {

namespace {

/// Two digits, or all before the point.
std::string rough(double value) {
  return value < 100.0 ? number_text(value, 2) : number_text(std::round(value));
}

}  // namespace

double round_down(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  const double lead = value / decade;
  if (lead >= 5.0) {
    return 5.0 * decade;
  }
  return lead >= 2.0 ? 2.0 * decade : decade;
}

std::vector<KeyLine> key_of(const Scales& scales, const KeyContents& contents) {
  std::vector<KeyLine> key;
  if (contents.ghost) {
    key.push_back({{ghost_color()}, "measured (ghost)"});
  }
  if (contents.forces) {
    key.push_back({{force_color()},
                   "ground force, 0.1 m for " + number_text(0.1 * scales.newtons_per_metre, 3) + " N"});
  }
  if (contents.springs != nullptr) {
    const bool turns = contents.springs->springs_turn();
    const double largest = scales.spring * (turns ? 180.0 / M_PI : 1e3);
    key.push_back({spring_colors(), "spring deflection, 0 to " + rough(largest) + (turns ? " deg" : " mm")});
  }
  if (contents.stretches) {
    const std::string how =
        scales.stretch == 1.0 ? "true to scale" : number_text(scales.stretch, 3) + " x enlarged";
    key.push_back({{stretch_color()}, "cable stretch, " + how});
  }
  return key;
}

std::string time_line(const Snapshot& shot, const std::vector<std::string>& phase_names) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "t = %.3f s", shot.time);
  std::string line = text.data();
  if (shot.phase > 0 && static_cast<std::size_t>(shot.phase) <= phase_names.size()) {
    line += "   phase " + phase_names[static_cast<std::size_t>(shot.phase) - 1];
  } else if (shot.phase > 0) {
    line += "   phase " + std::to_string(shot.phase);
  }
  return line;
}

}  // namespace plumbline::render
