// From the columns of a data file to checked signals in SI.
#pragma once

#include <Eigen/Core>
#include <string>

#include "simulator/trace/table.h"
#include "validation/trial/trial_file.h"

namespace plumbline::validation {

/// Where the data lie: in `data_folder` when it is given, otherwise in the folder that the trial's
/// environment variable names, otherwise beside trial.yaml. Throws InputError when the variable is needed and
/// not set.
std::string data_path(const TrialFile& file, const std::string& data_folder);

struct Signal {
  Eigen::VectorXd values;  ///< SI
  std::string unit;        ///< as declared
};

/// Throws InputError when the column is missing (with the nearest names), its unit is missing, wrong or not
/// the one that the data file states, or a value is NaN or infinite (with its row).
Signal read_signal(const Table& table, const ColumnUse& use);

/// Checks a time column in s: at least 20 samples, rising, every step within 1 % of the median step. Messages
/// name the row (1 is the first below the header) and the values. Returns the mean step, s.
double checked_period(const Eigen::VectorXd& time, const Table& table, const std::string& column);

}  // namespace plumbline::validation
