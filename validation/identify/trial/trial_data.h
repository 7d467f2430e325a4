// From the columns of a data file to checked signals in SI.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/trace/log_file.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {

/// Where the data lie: in `data_folder` when it is given, otherwise in the folder that the trial's
/// environment variable names, otherwise beside trial.yaml. Throws InputError when the variable is needed and
/// not set.
std::string data_path(const TrialFile& file, const std::string& data_folder);

struct Signal {
  Eigen::VectorXd values;  ///< SI; NaN where a cell is missing
  std::string unit;        ///< as declared
};

/// Throws InputError when the column is missing (with the nearest names), its unit is missing, wrong or not
/// the one that the data file states, or a cell is no finite number (with its line or row): text and
/// infinities always, a missing cell unless `may_miss`.
Signal read_signal(const LogFile& log, const ColumnUse& use, bool may_miss);

/// The rows of a log that have a time, and that time.
struct RowTimes {
  std::vector<Eigen::Index> rows;  ///< of the log; others are left out
  Eigen::VectorXd time;            ///< s, rising
  std::vector<std::string> remarks;
};

/// As many rows as rise together (the longest rising subsequence): a time that stands far ahead of those
/// behind it is left out, not they. Of a first or last row that is farther from the others than these are
/// from each other nothing is believed either.
std::vector<Eigen::Index> rising_rows(const Eigen::VectorXd& time);

/// Of the time column, or row by row of the rate. A time that begins later than 10^7 s is an absolute one
/// (seconds since 1970, or since a machine was started): it is counted from the first row. A time that is not
/// above the one before is refused; up to 1 % of the rows, which happens where a log is written by two
/// threads, are left out with a remark; with TrialFile::leave_out_bad_rows all that are not rising_rows().
RowTimes row_times(const TrialFile& file, const LogFile& log);

/// Values of the rows that are kept.
Eigen::VectorXd kept(const Eigen::VectorXd& values, const std::vector<Eigen::Index>& rows);

}  // namespace plumbline::validation
