// The battery's results in a file that grows by a line with every case, so that a long run can be stopped and
// go on later, on another machine too.
#pragma once

#include <string>
#include <vector>

#include "tests/battery/run_case.h"
#include "work/durations.h"

namespace plumbline::battery {

/// First line: the options on which every result depends; then a line of JSON for each result. What a result
/// also depends on is the program: a file belongs to one version of it.
class ResultsFile {
 public:
  /// Begins the file, or reads it. A last line that was not written to its end is dropped. Throws
  /// std::runtime_error, naming file and line, when the file cannot be written, is no such file or is of
  /// other options.
  ResultsFile(std::string file, const RunOptions& options);

  const std::vector<Result>& results() const { return results_; }
  /// nullptr when that case has not run yet.
  const Result* find(const std::string& name) const;
  void add(const Result& result);

 private:
  void read(const std::string& head);
  void append(const std::string& line) const;

  std::string file_;
  std::vector<Result> results_;
};

/// How long cases took, from a file of results of whatever options: what cannot be read in it is not known.
/// Throws std::runtime_error where there is no such file.
void add_durations(const std::string& file, work::Durations& durations);

}  // namespace plumbline::battery
