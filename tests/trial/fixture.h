// A small robot in memory and a scratch folder for trial files.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "simulator/model/model.h"
#include "simulator/trace/error.h"

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

inline void write_file(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline std::string file_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Replaces the first occurrence; the test is wrong when there is none.
inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  if (at == std::string::npos) {
    ADD_FAILURE() << "nothing to replace: " << what;
    return text;
  }
  return text.replace(at, what.size(), by);
}

/// The message of the InputError that `act` throws; fails when it throws none.
template <typename Act>
std::string input_error(const Act& act) {
  try {
    act();
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "no InputError";
  return "";
}

class ScratchFolder : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    for (char& c : name) {
      c = c == '/' ? '_' : c;
    }
    folder = std::filesystem::path(testing::TempDir()) / ("plumbline_" + name);
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
  const model::Model robot = small_robot();
};

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

}  // namespace plumbline::validation
