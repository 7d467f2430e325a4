// Recordings of a pendulum, and a batch over them.
#pragma once

#include <gmock/gmock.h>

#include <filesystem>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {

class BatchFolder : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    write("jobs.yaml", jobs({fit_row("A", "2026-03-01"), fit_row("A", "2026-03-02"), kCompare}));
  }

  static std::string jobs(const std::vector<std::string>& rows) {
    std::string text = "plumbline: batch/1\ntitle: A pendulum\nmodel: robot/model.yaml\nrows:\n";
    for (const std::string& row : rows) {
      text += "  - " + row + "\n";
    }
    return text;
  }
  static std::string fit_row(const std::string& robot, const std::string& day) {
    return "{robot: " + robot + ", day: " + day +
           ", mode: fit, free: ['viscous@*:damping'], trials: [trials/chirp, trials/swing]}";
  }
  static constexpr const char* kCompare = "{label: all, mode: compare, trials: [trials/chirp, trials/swing]}";
  static constexpr const char* kFails = "{label: nowhere, mode: compare, trials: [nothing]}";

  /// Every file of a batch's folder but durations.csv, which is no result, and what a rank that was killed
  /// had begun to write.
  std::map<std::string, std::string> results(const std::string& out) const {
    std::map<std::string, std::string> files;
    for (const auto& [name, text] : snapshot()) {
      if (name.rfind(out + "/", 0) == 0 && name.find("durations.csv") == std::string::npos &&
          name.find("/.") == std::string::npos) {
        files[name.substr(out.size())] = text;
      }
    }
    return files;
  }
};

}  // namespace plumbline::test
