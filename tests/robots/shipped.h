// The robots that ship, for tests that ask something of every one of them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace plumbline {

/// Model files that stand on no other one: without their effects overlays are the same machine.
inline std::vector<std::string> shipped_robots() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(PLUMBLINE_ROOT "/robots")) {
    std::string first, second;
    std::ifstream text(entry.path());
    if (entry.path().extension() == ".yaml" && std::getline(text, first) && first == "plumbline: model/1" &&
        std::getline(text, second) && second.rfind("base:", 0) != 0) {
      files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// "mabel_leg_bench", as the name of a test.
inline std::string robot_label(const testing::TestParamInfo<std::string>& info) {
  const std::filesystem::path file(info.param);
  return file.parent_path().filename().string() + "_" + file.stem().string();
}

}  // namespace plumbline
