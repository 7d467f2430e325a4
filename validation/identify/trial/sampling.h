// From the instants at which a log was written to even samples.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulator/trace/table.h"
#include "validation/identify/trial/trial.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {

/// A time in which nothing is known of a signal, s: from the last sample before to the first behind.
struct Gap {
  double from = 0.0, to = 0.0;
};

/// Rows of a log at rising times, and the even samples that are made of them. Where the rows are even already
/// (every step within 1 % of the median) and no period is asked for, the samples are the rows.
class Grid {
 public:
  /// `time` of the rows, s, rising. Throws InputError for fewer than 20 rows, and for gaps so long that there
  /// would be more than a hundred samples to a row.
  Grid(Eigen::VectorXd time, const LogSampling& sampling, const Place_in_file& where);

  const Eigen::VectorXd& time() const { return samples_; }
  double period() const { return period_; }
  /// Over longer gaps nothing is interpolated, s.
  double longest_gap() const { return longest_gap_; }
  /// Gaps between rows that are longer than that.
  const std::vector<Gap>& gaps() const { return gaps_; }
  double hair() const;  ///< times that are closer are the same, s
  /// What was done, a sentence; empty: nothing.
  const std::string& remark() const { return remark_; }

  /// Row values at the samples: linear between rows.
  Eigen::VectorXd interpolated(const Eigen::VectorXd& rows) const;
  /// Each value held until the next row, and the mean of that from each sample to the next: a held command
  /// keeps its impulse.
  Eigen::VectorXd held_mean(const Eigen::VectorXd& rows) const;
  /// The value of the last row at or before each sample.
  Eigen::VectorXd held(const Eigen::VectorXd& rows) const;

  /// Replaces NaN by what stands beside it: linear between the rows around, or with `hold` the row before.
  /// Appends to `gaps` where more than longest_gap() lies between them. False when there is no number at all.
  bool fill(Eigen::VectorXd& rows, bool hold, std::vector<Gap>& gaps) const;

  /// Samples that lie in none of the gaps, as stretches that hang together.
  std::vector<Stretch> stretches(const std::vector<Gap>& gaps) const;

 private:
  Eigen::Index row_before(double t, Eigen::Index guess) const;

  Eigen::VectorXd rows_, samples_;
  double period_ = 0.0, longest_gap_ = 0.0;
  bool rows_are_samples_ = true;
  std::vector<Gap> gaps_;
  std::string remark_;
};

}  // namespace plumbline::validation
