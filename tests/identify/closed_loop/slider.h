// A carriage on a guide, driven through a gain, with viscous friction: the exact motion under held commands.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "simulator/model/robot_file.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation::slider {

constexpr double kMass = 12.0;     // kg, 10 of the carriage and 2 of the motor
constexpr double kDamping = 30.0;  // N s/m
constexpr double kGain = 5.0;      // N/V
constexpr double kPeriod = 1e-3;   // s

inline model::Model read(const std::filesystem::path& folder) {
  std::ofstream(folder / "slider.sdf") << R"(<?xml version="1.0"?>
<sdf version="1.9"><model name="slider">
  <link name="carriage"><inertial><mass>10</mass>
    <inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>1</iyy><iyz>0</iyz><izz>1</izz></inertia></inertial></link>
  <joint name="guide" type="prismatic"><parent>world</parent><child>carriage</child><axis><xyz>1 0 0</xyz></axis></joint>
</model></sdf>
)";
  std::ofstream(folder / "slider.yaml") << R"(plumbline: model/1
robot: slider
skeleton: slider.sdf
coordinates:
  carriage: {of: {guide: 1}}
motors:
  drive:
    command_unit: V
    rotor_inertia: {value: 2, unit: kg, source: test}
    torque_constant: {value: 5, unit: N/V, source: test}
ratios:
  carriage: {motor: drive, ratio: {value: 1, unit: "1", source: test}}
effects:
  - {effect: viscous, at: carriage, values: {damping: {value: 30, unit: N s/m, source: test}}}
sensors:
  q: {measures: carriage, resolution: {value: 1e-8, unit: m, source: test}, noise: {value: 0, unit: m, source: test}, source: test}
)";
  return model::read_model((folder / "slider.yaml").string(), effects::Catalogue::all());
}

/// Position and velocity one period later under a constant force: M dv/dt = F - c v solved by hand.
struct State {
  double position = 0.0, velocity = 0.0;

  State after(double force) const {
    const double a = kDamping / kMass;
    const double fade = std::exp(-a * kPeriod);
    return {position + (1.0 - fade) / a * velocity + (kPeriod - (1.0 - fade) / a) * force / kDamping,
            fade * velocity + (1.0 - fade) * force / kDamping};
  }
};

}  // namespace plumbline::validation::slider
