// Tables, JSON files and the progress line.
#pragma once

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/identify/diagnose/screen.h"

namespace plumbline::cli {

/// Left-aligned columns, two spaces apart.
void print_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows);

/// Writes to `file` unless it is empty.
void write_json(const nlohmann::json& json, const std::string& file);

/// One line on a terminal's standard error, with time left; nothing in a pipe.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;
  validation::Progress callback();

 private:
  void show(const std::string& what, double fraction);
  bool terminal_;
  std::chrono::steady_clock::time_point start_, part_start_;
  double last_fraction_ = 0.0;
};

}  // namespace plumbline::cli
