// What a log that nobody has described may be: its columns, how it was sampled, and what each column could
// mean.
#pragma once

#include <string>
#include <vector>

#include "simulator/trace/log_file.h"

namespace plumbline::validation {

enum class ColumnRole { time, command, position, rate, reference, contact, force, other };
/// "time", "command", ...
std::string to_string(ColumnRole role);

struct ColumnLook {
  std::string name;
  std::string unit;            ///< in the data file, or a guess
  bool unit_is_guess = false;  ///< the file states none
  double lowest = 0.0, highest = 0.0;
  double step = 0.0;  ///< smallest difference of two values that occur: the resolution; 0: no two
  /// Standard deviation about a smooth motion; 0: too few rows, or the values rest. Rows are taken as even.
  /// The differences of order p of independent noise have the variance C(2p, p) sigma^2, and a motion that is
  /// smooth over p rows adds nothing to them; sigma is the least of the estimates for p = 2 to 10, each from
  /// the median of the magnitudes, so that shocks do not count (Gasser, Sroka and Jennen-Steinmetz,
  /// Biometrika 73, 1986).
  double scatter = 0.0;
  long values = 0;   ///< how many different ones, at most 1000 counted
  long missing = 0;  ///< cells without a number
  std::string text;  ///< such a cell that is no missing one
  ColumnRole role = ColumnRole::other;
  std::string why;  ///< the reason for the role
};

struct LogLook {
  std::string file;
  long rows = 0;
  std::vector<ColumnLook> columns;
  int time = -1;                                                      ///< index in `columns`; -1: none found
  double time_scale = 1.0;                                            ///< s for each unit of the time column
  double start = 0.0;                                                 ///< s
  double duration = 0.0;                                              ///< s
  double median_step = 0.0, shortest_step = 0.0, longest_step = 0.0;  ///< s
  long gaps = 0;                                                      ///< steps of more than five median ones
  long not_rising = 0;  ///< rows whose time is not above that of the row before
  std::vector<std::string> remarks;
  std::vector<std::string> topics;  ///< of a bag

  const ColumnLook* find(ColumnRole role) const;  ///< the first of this role, or nullptr
};

/// Time: a column that rises and is called so, its unit by its name, its size or its step. Roles by the words
/// in the names (q, theta, pos; dq, vel, gyro; tau, torque, current, pwm; ref, goal, des; contact), and by
/// the numbers: 0 and 1 alone make a contact, and what equals the difference of a position is its rate, whose
/// unit follows from the factor between them. Angles of more than two turns that no encoder of several turns
/// explains are taken as degrees. Guesses only: a person looks at them.
LogLook look_at(const LogFile& log);

}  // namespace plumbline::validation
