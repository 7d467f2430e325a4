// A folder with a robot and recordings of its twin, a fresh copy for each test.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/cli/program.h"

namespace plumbline::test {

/// robot/ (the pendulum's files), experiments/, and trials/ that `plumbline twin` made from them, 500 Hz:
/// chirp and steps (train), swing (held-out). Hidden in them: Coulomb friction at the drive.
class RobotFolder : public testing::Test {
 public:
  static constexpr double kHiddenLevel = 0.008;         // N m
  static constexpr double kHiddenSmoothingSpeed = 0.5;  // rad/s

 protected:
  void SetUp() override;
  void TearDown() override;

  Outcome plumbline(const std::vector<std::string>& arguments) const { return run(arguments, folder); }
  /// The same, and fails the test when the exit status is not 0.
  Outcome succeed(const std::vector<std::string>& arguments) const;

  std::string read(const std::string& name) const;
  nlohmann::json read_json(const std::string& name) const;
  void write(const std::string& name, const std::string& text) const;
  /// Replaces the first occurrence; fails the test when there is none.
  void replace(const std::string& name, const std::string& what, const std::string& by) const;
  void remove(const std::string& name) const;
  /// Every file and its content.
  std::map<std::string, std::string> snapshot() const;
  /// Names of files that have come, gone or changed.
  std::vector<std::string> changed_since(const std::map<std::string, std::string>& before) const;

  std::string folder;
};

/// Names of an object's members.
std::vector<std::string> keys(const nlohmann::json& object);

}  // namespace plumbline::test
