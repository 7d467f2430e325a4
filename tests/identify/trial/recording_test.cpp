// Recordings as a force plate leaves them: no header, no time, empty at first, several experiments in one
// file.
#include <gtest/gtest.h>

#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

/// A robot without motors on a plate with a contact switch; one coordinate that no sensor shows.
model::Model robot_on_a_plate() {
  model::Model robot;
  robot.file = "robot.yaml";
  robot.coordinates = {{"height", false, {{"rail", 1.0}}}};
  robot.feet = {{"toe", 0, Eigen::Vector3d::Zero(), "", 0.0, ""}};
  robot.sensors = {{"plate", "", 1.0, 0, 0, "", {0}}};
  robot.switches = {{"touch", 0, ""}};
  return robot;
}

/// 60 rows: -3 N on the empty plate, and 100 N under the foot in rows 20 to 29 and 40 to 49.
std::string plate_rows() {
  std::string rows = "\n";
  for (int k = 0; k < 60; ++k) {
    const bool stands = (k >= 20 && k < 30) || (k >= 40 && k < 50);
    rows += stands ? " 1.5, 97.0\n" : " 1.5, -3.0\n";
  }
  return rows;
}

std::string plate_trial() {
  return R"(plumbline: trial/1
title: On the plate
model: robot.yaml
role: train
data: rows.txt
columns: [Fx, Fz]
time: {rate: {value: 100, unit: Hz}}
section: {from: {value: 0.1, unit: s}, to: {value: 0.35, unit: s}}
measured:
  plate: {column: Fz, unit: N, zero: {from: {value: 0, unit: s}, to: {value: 0.1, unit: s}}}
  touch: {column: Fz, unit: N, above: {value: 20, unit: N}}
start:
  height: {value: 20, unit: cm, uncertainty: 1, assumed: test}
)";
}

class Recording : public ScratchFolder {
 protected:
  Trial trial(const std::string& name, const std::string& yaml) {
    std::filesystem::create_directories(folder / name);
    write_file(folder / "rows.txt", plate_rows());
    write_file(folder / name / "trial.yaml", replaced(yaml, "rows.txt", "../rows.txt"));
    return read_trial((folder / name).string(), robot_on_a_plate());
  }
};

TEST_F(Recording, IsReadWithoutHeaderAndTime) {
  const Trial read = trial("a", plate_trial());
  ASSERT_EQ(read.samples(), 25);
  EXPECT_DOUBLE_EQ(read.time[0], 0.1);
  EXPECT_DOUBLE_EQ(read.period, 0.01);
  EXPECT_EQ(read.first_row, 10);
  EXPECT_TRUE(read.commands.empty());
  EXPECT_DOUBLE_EQ(read.measured[0].values[0], 0.0);
  EXPECT_DOUBLE_EQ(read.measured[0].values[10], 100.0);
  EXPECT_EQ(read.switches[0].values.sum(), 10.0);
  ASSERT_EQ(read.contact_events.size(), 2U);
  EXPECT_NEAR(read.contact_events[0].time, 0.195, 1e-12);
  ASSERT_EQ(read.start.size(), 1U);
  EXPECT_DOUBLE_EQ(read.start[0].position, 0.2);
  EXPECT_DOUBLE_EQ(read.start[0].deviation, 0.01);
}

TEST_F(Recording, TwoRolesMayShareAFileButNoRow) {
  const Trial train = trial("a", plate_trial());
  const std::string held_out = replaced(plate_trial(), "role: train", "role: held-out");
  const std::string later =
      replaced(replaced(held_out, "value: 0.1, unit: s}, to", "value: 0.35, unit: s}, to"),
               "to: {value: 0.35", "to: {value: 0.59");
  check_roles({train, trial("b", later)});
  const std::string overlapping = replaced(later, "from: {value: 0.35", "from: {value: 0.34");
  const std::string message = input_error([&] { check_roles({train, trial("c", overlapping)}); });
  EXPECT_NE(message.find("data file of the train trial"), std::string::npos) << message;
}

TEST_F(Recording, OneFlightIsBetweenTheStances) {
  const Trial read = trial("a", replaced(plate_trial(), "to: {value: 0.35", "to: {value: 0.58"));
  const std::optional<Flight> flight = flight_at(read, 25);
  ASSERT_TRUE(flight.has_value());
  EXPECT_NEAR(flight->lift_off, 0.295, 1e-12);
  EXPECT_NEAR(flight->touchdown, 0.395, 1e-12);
  EXPECT_FALSE(flight_at(read, 0).has_value()) << "its lift-off is not in the recording";
  EXPECT_FALSE(flight_at(read, 15).has_value()) << "on the ground";
}

struct BadRecording {
  const char *name, *what, *by, *message;
};

class BadRecordings : public Recording, public testing::WithParamInterface<BadRecording> {};

TEST_P(BadRecordings, AreRefusedInOneClearLine) {
  const BadRecording& bad = GetParam();
  const std::string message = input_error([&] { trial("bad", replaced(plate_trial(), bad.what, bad.by)); });
  EXPECT_NE(message.find(bad.message), std::string::npos) << message;
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Plate, BadRecordings,
    testing::Values(BadRecording{"too_few_names", "[Fx, Fz]", "[Fz]", "2 fields"},
                    BadRecording{"name_twice", "[Fx, Fz]", "[Fz, Fz]", "twice"},
                    BadRecording{"no_rate", "value: 100, unit: Hz", "value: 0, unit: Hz", "above zero"},
                    BadRecording{"rate_unit", "unit: Hz", "unit: s", "Hz"},
                    BadRecording{"backwards", "value: 0.1, unit: s}, to", "value: 0.4, unit: s}, to",
                                 "not after `from`"},
                    BadRecording{"too_late", "to: {value: 0.35", "to: {value: 35", "lasts from 0 to 0.59 s"},
                    BadRecording{"force_unit", "column: Fz, unit: N, zero", "column: Fz, unit: m, zero",
                                 "force plate plate"},
                    BadRecording{"unknown_start", "height:", "hight:", "height"},
                    BadRecording{"uncertain", "uncertainty: 1, ", "", "no uncertainty"}),
    [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace plumbline::validation
