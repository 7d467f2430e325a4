// A small robot and the texts of a good trial and a good experiment for it.
#pragma once

#include <sstream>
#include <string>

#include "simulator/model/model.h"

namespace plumbline::validation {

/// Two motors (one turns and takes torque, one slides and takes voltage), a sensor on each.
inline model::Model small_robot() {
  model::Model robot;
  robot.file = "robot.yaml";
  robot.coordinates = {{"leg", true, {{"hip", 1.0}}}, {"carriage", false, {{"slide", 1.0}}}};
  model::Motor turning;
  turning.name = "mLeg";
  turning.command_unit = "N m";
  model::Motor sliding;
  sliding.name = "drive";
  sliding.angular = false;
  sliding.command_unit = "V";
  robot.motors = {turning, sliding};
  robot.sensors = {{"angle", "mLeg", 0.003, 0, 0, ""}, {"place", "carriage", 1e-7, 0, 0, ""}};
  return robot;
}

/// 30 rows at 10 ms: torque k/10, voltage k in mV, angle k in degrees, place 2k in mm, reference 3k in mm.
inline std::string good_csv() {
  std::ostringstream csv;
  csv << "t [s],u [N m],v [mV],angle [deg],place [mm],reference [mm]\n";
  for (int k = 0; k < 30; ++k) {
    csv << 0.01 * k << ',' << 0.1 * k << ',' << k << ',' << k << ',' << 2 * k << ',' << 3 * k << '\n';
  }
  return csv.str();
}

inline std::string good_trial() {
  return R"(plumbline: trial/1
title: A test
model: ../robots/robot.yaml
role: train
data: data.csv
time: {column: t, unit: s}
commands:
  mLeg: {column: u, unit: N m}
  drive: {column: v}
measured:
  angle: {column: angle, unit: deg}
  place: {column: place}
locked:
  leg: {value: 90, unit: deg}
  drive: {value: 5, unit: mm}
controllers:
  - kind: cascade_pd
    motor: drive
    sensor: place
    reference: {column: reference}
    position_gain: {value: 160, unit: 1/s, source: test}
    velocity_gain: {value: 0.25, unit: V s/mm, source: test}
    command_limit: {value: 10, unit: V}
    velocity_over: 2
events: [0.1 s, 200 ms]
)";
}

inline std::string good_experiment() {
  return R"(plumbline: experiment/1
title: A test
role: held-out
duration: {value: 2, unit: s}
sample_period: {value: 10, unit: ms}
start: {leg: {value: 12, unit: deg}, carriage: {value: 4, unit: mm}}
locked: [mLeg]
commands:
  mLeg:
    - {kind: stepped_chirp, from: 1 Hz, to: 4 Hz, steps: 2, first_amplitude: 1, last_amplitude: 2, unit: N m}
    - {kind: constant, value: 100, unit: N mm}
    - {kind: ramp, start: 0, end: 1, unit: N m}
  drive:
    - {kind: multisine, frequencies: [2 Hz], amplitudes: [5], phases: [90 deg], unit: V}
    - {kind: steps, times: [0.5 s], levels: [250], unit: mV}
    - {kind: pulses, times: [1 s], width: 20 ms, level: 1, unit: V}
    - {kind: filtered_noise, deviation: 1e-9, corner: 5 Hz, seed: 1, unit: V}
)";
}

}  // namespace plumbline::validation
