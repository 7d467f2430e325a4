#include "validation/identify/trial/write_trial.h"

#include <unistd.h>

#include "tests/identify/trial/fixture.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

class WriteTrial : public ScratchFolder {
 protected:
  Trial original() {
    fs::create_directories(folder / "original");
    write_file(folder / "original" / "trial.yaml", good_trial());
    write_file(folder / "original" / "data.csv", good_csv());
    return read_trial((folder / "original").string(), robot);
  }
  long entries() const { return std::distance(fs::directory_iterator(folder), fs::directory_iterator()); }
};

void expect_near(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-13 * (1 + b.cwiseAbs().maxCoeff()));
}

TEST_F(WriteTrial, ComesBackTheSame) {
  Trial trial = original();
  trial.title = "Odd: \"title\" # with, signs";
  trial.role = Role::held_out;
  trial.controllers[0].disturbance = Eigen::VectorXd::LinSpaced(30, 0.0, 1.0);
  const std::string target = (folder / "new" / "deep" / "copy").string();
  write_trial(trial, robot, target + "/");
  const Trial back = read_trial(target, robot);

  EXPECT_EQ(back.name, "copy");
  EXPECT_EQ(back.title, trial.title);
  EXPECT_EQ(back.role, Role::held_out);
  EXPECT_EQ(fs::path(back.model_file), fs::path(trial.model_file));
  expect_near(back.time, trial.time);
  ASSERT_EQ(back.measured.size(), 2U);
  ASSERT_EQ(back.commands.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(back.measured[i].sensor, trial.measured[i].sensor);
    EXPECT_EQ(back.measured[i].column, trial.measured[i].column);
    EXPECT_EQ(back.measured[i].unit, trial.measured[i].unit);
    expect_near(back.measured[i].values, trial.measured[i].values);
    EXPECT_EQ(back.commands[i].motor, trial.commands[i].motor);
    EXPECT_EQ(back.commands[i].unit, trial.commands[i].unit);
    expect_near(back.commands[i].values, trial.commands[i].values);
  }
  ASSERT_EQ(back.locks.size(), 2U);
  EXPECT_DOUBLE_EQ(back.locks[0].value, trial.locks[0].value);
  EXPECT_DOUBLE_EQ(back.locks[1].value, trial.locks[1].value);
  ASSERT_EQ(back.controllers.size(), 1U);
  EXPECT_EQ(back.controllers[0].kind, "cascade_pd");
  EXPECT_DOUBLE_EQ(back.controllers[0].position_gain, trial.controllers[0].position_gain);
  EXPECT_DOUBLE_EQ(back.controllers[0].velocity_gain, trial.controllers[0].velocity_gain);
  EXPECT_DOUBLE_EQ(back.controllers[0].command_limit, trial.controllers[0].command_limit);
  EXPECT_EQ(back.controllers[0].velocity_over, 2);
  expect_near(back.controllers[0].reference, trial.controllers[0].reference);
  expect_near(back.controllers[0].disturbance, trial.controllers[0].disturbance);
  EXPECT_EQ(back.events, trial.events);
}

TEST_F(WriteTrial, NamesAndUnitsThatAreMissingAreMade) {
  Trial trial = original();
  trial.controllers.clear();
  trial.locks.clear();
  trial.events.clear();
  for (std::size_t i = 0; i < 2; ++i) {
    trial.measured[i].column = trial.measured[i].unit = "";
    trial.commands[i].column = trial.commands[i].unit = "";
  }
  write_trial(trial, robot, (folder / "copy").string());
  EXPECT_EQ(file_text(folder / "copy" / "data.csv").substr(0, 66),
            "t [s],u_mLeg [N m],u_drive [V],q_angle [rad],q_place [m]\n0,0,0,0,0");
  const Trial back = read_trial((folder / "copy").string(), robot);
  expect_near(back.measured[1].values, trial.measured[1].values);
}

TEST_F(WriteTrial, RefusesWhatIsThereAndLeavesItAlone) {
  const Trial trial = original();
  const std::string before = file_text(folder / "original" / "data.csv");
  const std::string message = input_error([&] { write_trial(trial, robot, (folder / "original").string()); });
  EXPECT_NE(message.find("found a folder that is not empty, expected a new folder"), std::string::npos)
      << message;
  EXPECT_EQ(file_text(folder / "original" / "data.csv"), before);
  write_file(folder / "file", "mine");
  const std::string of_file = input_error([&] { write_trial(trial, robot, (folder / "file").string()); });
  EXPECT_NE(of_file.find("found a file of this name, expected a new folder"), std::string::npos) << of_file;
  EXPECT_EQ(file_text(folder / "file"), "mine");
  EXPECT_EQ(entries(), 2);
}

TEST_F(WriteTrial, AnEmptyFolderIsFilled) {
  const Trial trial = original();
  fs::create_directories(folder / "empty");
  write_trial(trial, robot, (folder / "empty").string());
  EXPECT_EQ(read_trial((folder / "empty").string(), robot).samples(), 30);
}

TEST_F(WriteTrial, NothingIsLeftWhenWritingFails) {
  Trial trial = original();
  trial.measured[0].values.conservativeResize(12);  // a bug of the caller: the table is refused on the way
  EXPECT_ANY_THROW(write_trial(trial, robot, (folder / "broken").string()));
  EXPECT_EQ(entries(), 1);
}

TEST_F(WriteTrial, TemplateReadsOnceNamesAreFilledIn) {
  new_trial_template((folder / "template").string());
  EXPECT_TRUE(fs::exists(folder / "template" / "README.md"));
  std::string yaml = file_text(folder / "template" / "trial.yaml");
  yaml = replaced(yaml, "  motor: {column", "  mLeg: {column");
  yaml = replaced(yaml, "  encoder: {column", "  angle: {column");
  write_file(folder / "template" / "trial.yaml", yaml);
  EXPECT_EQ(read_trial((folder / "template").string(), robot).samples(), 25);
}

// What the template shows behind a # must be right too.
TEST_F(WriteTrial, TemplatesOptionalKeysAreReadable) {
  new_trial_template((folder / "template").string());
  std::istringstream in(file_text(folder / "template" / "trial.yaml"));
  std::string yaml;
  for (std::string line; std::getline(in, line);) {
    const bool optional = line.rfind("# ", 0) == 0 && line.find("Lines with") == std::string::npos;
    yaml += (optional ? line.substr(2) : line) + "\n";
  }
  yaml = replaced(yaml, "data_folder_env: MY_DATA", "");
  yaml = replaced(yaml, "  motor: {column", "  mLeg: {column");
  yaml = replaced(yaml, "  encoder: {column", "  angle: {column");
  yaml = replaced(yaml, "other_motor", "leg");
  yaml = replaced(yaml, "motor: motor", "motor: mLeg");
  yaml = replaced(yaml, "sensor: encoder", "sensor: angle");
  yaml = replaced(yaml, "events: [1.25 s]", "events: [0.1 s]");
  write_file(folder / "template" / "trial.yaml", yaml);
  write_file(folder / "template" / "data.csv",
             replaced(replaced(replaced(good_csv(), "u [N m],v [mV]", "u_motor [N m],d_motor [N m]"),
                               "angle [deg]", "q_encoder [rad]"),
                      "reference [mm]", "r_encoder [rad]"));
  const Trial trial = read_trial((folder / "template").string(), robot);
  EXPECT_EQ(trial.controllers.size(), 1U);
  EXPECT_EQ(trial.locks.size(), 1U);
  EXPECT_EQ(trial.events.size(), 1U);
}

TEST_F(WriteTrial, TemplateDoesNotOverwrite) {
  new_trial_template((folder / "template").string());
  write_file(folder / "template" / "trial.yaml", "mine");
  EXPECT_NE(input_error([&] {
              new_trial_template((folder / "template").string());
            }).find("found a folder that is not empty, expected a new folder"),
            std::string::npos);
  EXPECT_EQ(file_text(folder / "template" / "trial.yaml"), "mine");
}

TEST_F(WriteTrial, FolderThatCannotBeMadeIsOneClearError) {
  write_file(folder / "file", "");
  for (const std::string& bad :
       {(folder / "file" / "below").string(), std::string("/proc/plumbline/trial"), std::string()}) {
    const std::string message = input_error([&] { new_trial_template(bad); });
    EXPECT_NE(message.find("expected a new folder"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST_F(WriteTrial, ReadOnlyFolderIsOneClearError) {
  if (geteuid() == 0) {
    GTEST_SKIP() << "the superuser may write everywhere";
  }
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  const std::string message = input_error([&] { new_trial_template((folder / "trial").string()); });
  fs::permissions(folder, fs::perms::owner_all);
  EXPECT_NE(message.find("Permission denied"), std::string::npos) << message;
}

}  // namespace
}  // namespace plumbline::validation
