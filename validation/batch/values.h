// The values that rows found, held against each other: over robots, and over days.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace plumbline::batch {

/// A value as one row found it. The interval is the row's own, 95 %.
struct RowValue {
  std::size_t row = 0;
  std::string robot;
  std::optional<double> day;
  double value = 0.0;
  double deviation = 0.0;           ///< one standard deviation; 0: not known
  double lower = 0.0, upper = 0.0;  ///< both the value where it has no interval
};

/// A straight line over the days of one robot,
///   value = a + b day,   by least squares with weights 1/deviation^2 (equal where one is not known).
/// Its standard deviation is sqrt(1 / sum w (t - mean t)^2), times the Birge ratio sqrt(chi^2 / (n - 2))
/// where that is above 1 (R. T. Birge, Phys. Rev. 40 (1932) 207); without deviations from the scatter alone.
/// It drifts where |b| exceeds the quantile of its standard deviation: Student's with n - 2 degrees of
/// freedom where the scatter made it, else the normal one, at 5 % shared among all lines of the batch
/// (Bonferroni).
struct Drift {
  std::string robot;
  std::size_t days = 0;
  double slope = 0.0, deviation = 0.0;  ///< in the value's unit, per day
  double mean_day = 0.0, mean = 0.0;    ///< through which the line passes
  double limit = 0.0;                   ///< |slope| above which it drifts
  bool drifts() const { return std::abs(slope) > limit; }
};

/// One value of all rows that have it.
struct ValueOverRows {
  std::string name, unit;
  std::vector<RowValue> rows;
  /// Mean of the rows with a 95 % interval, by weights 1/(deviation^2 + between), `between` the variance by
  /// which rows differ beyond their deviations: max(0, (chi^2 - (n - 1)) / (W - sum w^2/W)), w =
  /// 1/deviation^2, W their sum (R. DerSimonian, N. Laird, Controlled Clinical Trials 7 (1986) 177-188);
  /// Student's t with n - 1 degrees of freedom where that is above 0, else the normal quantile. Where a
  /// deviation is not known: the plain mean and the scatter. One row: that row's own.
  double mean = 0.0, lower = 0.0, upper = 0.0;
  /// Probability of a chi^2 as large as that of the rows about their mean, were they all the same; 1 where no
  /// deviation is known or there is one row.
  double probability = 1.0;
  bool differs = false;  ///< the probability is below 5 %, shared among all values (Bonferroni)
  std::vector<Drift> drifts;
};

/// Of rows as run_row() gives them; the values in the order in which they are met first. A diagnosis gives
/// the parameters of what it named, a fit those it fitted, a comparison its two errors in floors.
std::vector<ValueOverRows> values_over(const std::vector<nlohmann::json>& rows);

/// An effect at a place, and the rows in which it was named or is a rival of what was.
struct EffectOverRows {
  std::string effect, at;
  std::vector<std::size_t> named, rival;
  std::string label() const { return effect + "@" + at; }
};
std::vector<EffectOverRows> effects_over(const std::vector<nlohmann::json>& rows);

/// A value's name and unit, and what one row has of it.
struct NamedValue {
  std::string name, unit;
  RowValue value;
};
std::vector<NamedValue> values_of(const nlohmann::json& row, std::size_t index);

}  // namespace plumbline::batch
