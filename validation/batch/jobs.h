// A batch: a table of models and trials, one row a robot or a day (docs/batch.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace plumbline::batch {

enum class Mode { diagnose, compare, fit };
std::string to_string(Mode mode);

struct Row {
  std::string label;                ///< names its files; unique, letters, digits, "." "_" "-"
  std::string robot;                ///< empty: not said
  std::string day;                  ///< as in the file: 2026-03-14, or a number of days; empty: not said
  std::optional<double> day_count;  ///< days since 1970-01-01, or the number
  Mode mode = Mode::diagnose;
  std::string model;  ///< file; empty: the one that the first trial names
  std::string data_folder;
  std::vector<std::string> trials;
  std::vector<std::string> free;     ///< of a fit: patterns of parameters
  std::vector<std::string> without;  ///< of a diagnosis: effects left out of the catalogue
  int most = 0;                      ///< of a diagnosis: most effects to accept; 0: as `plumbline diagnose`
  double window = 0.5;               ///< s
};

struct Jobs {
  std::string file, title;
  std::vector<Row> rows;
};

/// Reads `plumbline: batch/1`. What stands beside `rows` holds for every row that says nothing else. Paths
/// are relative to the file. Throws InputError with file, line and key.
Jobs read_jobs(const std::string& path);

/// Days since 1970-01-01 of a date YYYY-MM-DD; nothing for a text that is no date.
std::optional<double> days_of(const std::string& date);

}  // namespace plumbline::batch
