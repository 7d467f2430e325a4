#include <cstdlib>

#include "simulator/trace/table.h"
#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;
namespace fs = std::filesystem;

class ReadTrial : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    fs::create_directories(folder / "swing");
    write_file(folder / "swing" / "trial.yaml", good_trial());
    write_file(folder / "swing" / "data.csv", good_csv());
  }
};

TEST_F(ReadTrial, EverythingComesOutInSi) {
  const Trial trial = read_trial((folder / "swing").string(), robot);
  EXPECT_EQ(trial.name, "swing");
  EXPECT_EQ(trial.title, "A test");
  EXPECT_EQ(trial.role, Role::train);
  EXPECT_EQ(fs::path(trial.model_file), folder / "robots" / "robot.yaml");
  EXPECT_EQ(fs::path(trial.data_file), folder / "swing" / "data.csv");
  ASSERT_EQ(trial.samples(), 30);
  EXPECT_NEAR(trial.period, 0.01, 1e-12);
  ASSERT_EQ(trial.commands.size(), 2U);
  EXPECT_EQ(trial.commands[0].motor, "mLeg");
  EXPECT_NEAR(trial.commands[0].values[7], 0.7, 1e-12);
  EXPECT_EQ(trial.commands[1].unit, "mV");
  EXPECT_NEAR(trial.commands[1].values[7], 0.007, 1e-12);
  ASSERT_EQ(trial.measured.size(), 2U);
  EXPECT_EQ(trial.measured[0].sensor, "angle");
  EXPECT_EQ(trial.measured[0].unit, "deg");
  EXPECT_NEAR(trial.measured[0].values[9], 9 * kPi / 180, 1e-12);
  EXPECT_NEAR(trial.measured[1].values[9], 0.018, 1e-12);
  ASSERT_EQ(trial.locks.size(), 2U);
  EXPECT_NEAR(trial.locks[0].value, kPi / 2, 1e-12);
  EXPECT_NEAR(trial.locks[1].value, 0.005, 1e-12);
  ASSERT_EQ(trial.controllers.size(), 1U);
  EXPECT_NEAR(trial.controllers[0].velocity_gain, 250, 1e-9);
  EXPECT_NEAR(trial.controllers[0].position_gain, 160, 1e-9);
  EXPECT_NEAR(trial.controllers[0].command_limit, 10, 1e-12);
  EXPECT_NEAR(trial.controllers[0].reference[5], 0.015, 1e-12);
  EXPECT_EQ(trial.controllers[0].disturbance.size(), 0);
  EXPECT_EQ(trial.controllers[0].velocity_over, 2);
  ASSERT_EQ(trial.events.size(), 2U);
  EXPECT_NEAR(trial.events[1], 0.2, 1e-12);
}

TEST_F(ReadTrial, FolderAndFileAreTheSame) {
  const Trial by_file = read_trial((folder / "swing" / "trial.yaml").string(), robot);
  EXPECT_EQ(by_file.name, "swing");
  EXPECT_EQ(read_trial((folder / "swing/").string(), robot).data_file, by_file.data_file);
}

TEST_F(ReadTrial, NamesItsModelWithoutReadingData) {
  fs::remove(folder / "swing" / "data.csv");
  EXPECT_EQ(fs::path(model_of_trial((folder / "swing").string())), folder / "robots" / "robot.yaml");
}

TEST_F(ReadTrial, DataFolderFromOptionReplacesTheTrials) {
  fs::create_directories(folder / "elsewhere");
  fs::rename(folder / "swing" / "data.csv", folder / "elsewhere" / "data.csv");
  TrialOptions options;
  options.data_folder = (folder / "elsewhere").string();
  EXPECT_EQ(read_trial((folder / "swing").string(), robot, options).samples(), 30);
}

TEST_F(ReadTrial, DataFolderFromTheEnvironment) {
  fs::create_directories(folder / "elsewhere");
  fs::rename(folder / "swing" / "data.csv", folder / "elsewhere" / "data.csv");
  write_file(
      folder / "swing" / "trial.yaml",
      replaced(good_trial(), "data: data.csv\n", "data: data.csv\ndata_folder_env: PLUMBLINE_TEST_DATA\n"));
  const auto read = [&] { return read_trial((folder / "swing").string(), robot); };

  ASSERT_EQ(unsetenv("PLUMBLINE_TEST_DATA"), 0);
  const std::string message = input_error(read);
  EXPECT_NE(message.find("trial.yaml:6: data_folder_env"), std::string::npos) << message;
  EXPECT_NE(message.find("PLUMBLINE_TEST_DATA"), std::string::npos) << message;
  EXPECT_NE(message.find("--data"), std::string::npos) << message;

  ASSERT_EQ(setenv("PLUMBLINE_TEST_DATA", (folder / "elsewhere").c_str(), 1), 0);
  EXPECT_EQ(read().samples(), 30);
  ASSERT_EQ(unsetenv("PLUMBLINE_TEST_DATA"), 0);
}

TEST_F(ReadTrial, MatlabFileWithUnitsFromTheTrial) {
  Table table = read_csv((folder / "swing" / "data.csv").string());
  write_mat(table, (folder / "swing" / "data.mat").string());
  std::string yaml = replaced(good_trial(), "data.csv", "data.mat");
  yaml = replaced(yaml, "{column: v}", "{column: v, unit: mV}");
  yaml = replaced(yaml, "{column: place}", "{column: place, unit: mm}");
  yaml = replaced(yaml, "{column: reference}", "{column: reference, unit: mm}");
  write_file(folder / "swing" / "trial.yaml", yaml);
  const Trial trial = read_trial((folder / "swing").string(), robot);
  EXPECT_NEAR(trial.commands[1].values[7], 0.007, 1e-12);
  EXPECT_NEAR(trial.measured[1].values[9], 0.018, 1e-12);

  write_file(folder / "swing" / "trial.yaml", replaced(yaml, "{column: v, unit: mV}", "{column: v}"));
  const std::string message = input_error([&] { read_trial((folder / "swing").string(), robot); });
  EXPECT_NE(
      message.find("trial.yaml:9: commands.drive.column: found no unit for column \"v\", expected `unit: V`"),
      std::string::npos)
      << message;
}

TEST_F(ReadTrial, NanInAMatlabColumnNamesTheRow) {
  Table table = read_csv((folder / "swing" / "data.csv").string());
  for (const double bad : {std::nan(""), static_cast<double>(HUGE_VAL)}) {
    table.columns[3].values[11] = bad;
    write_mat(table, (folder / "swing" / "data.mat").string());
    write_file(folder / "swing" / "trial.yaml", replaced(good_trial(), "data.csv", "data.mat"));
    std::string yaml = replaced(good_trial(), "data.csv", "data.mat");
    write_file(folder / "swing" / "trial.yaml", replaced(yaml, "{column: v}", "{column: v, unit: mV}"));
    const std::string message = input_error([&] { read_trial((folder / "swing").string(), robot); });
    EXPECT_NE(message.find("data.mat: angle: found "), std::string::npos) << message;
    EXPECT_NE(message.find("in row 12, expected finite"), std::string::npos) << message;
  }
}

TEST_F(ReadTrial, ARecordMayStateItsOwnResolutionNoiseAndZeroError) {
  const std::string own =
      "unit: deg, resolution: {value: 0.6, unit: deg}, noise: {value: 0.1, unit: deg}, "
      "offset_uncertainty: {value: 2, unit: deg}}";
  write_file(folder / "swing" / "trial.yaml", replaced(good_trial(), "unit: deg}", own));
  const Trial trial = read_trial((folder / "swing").string(), robot);
  const double degree = kPi / 180;
  EXPECT_NEAR(trial.measured[0].offset_uncertainty, 2 * degree, 1e-15);
  EXPECT_EQ(trial.measured[1].offset_uncertainty, 0.0);
  // sqrt(0.6^2/12 + 0.1^2) = 0.2 degrees; the other sensor is as the model says.
  EXPECT_NEAR(sensor_of(robot, trial.measured[0]).floor(), 0.2 * degree, 1e-15);
  EXPECT_EQ(sensor_of(robot, trial.measured[1]).floor(), robot.sensors[1].floor());
  const model::Model recorded = as_recorded(robot, trial);
  EXPECT_NEAR(recorded.sensors[0].floor(), 0.2 * degree, 1e-15);
  EXPECT_EQ(recorded.sensors[1].floor(), robot.sensors[1].floor());
  EXPECT_EQ(robot.sensors[0].resolution, 0.003);
}

TEST_F(ReadTrial, JitterBelowOnePercentIsTaken) {
  std::string csv = replaced(good_csv(), "\n0.05,", "\n0.05009,");
  write_file(folder / "swing" / "data.csv", csv);
  EXPECT_NEAR(read_trial((folder / "swing").string(), robot).period, 0.01, 1e-12);
}

}  // namespace
}  // namespace plumbline::validation
