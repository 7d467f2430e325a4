#include "validation/identify/trial/trial_data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <vector>

#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"
#include "validation/identify/trial/physical_number.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

constexpr int kDigits = 9;  // enough to see the difference of two sample times

std::string seconds(double value) { return number_text(value, kDigits) + " s"; }

std::string row_name(Eigen::Index index) { return "row " + std::to_string(index + 1); }

const Column& find_column(const Table& table, const ColumnUse& use) {
  const Column* column = table.find(use.name);
  if (column == nullptr && !use.name.empty() && use.name.front() == '/') {
    column = table.find(use.name.substr(1));  // a dataset of HDF5
  }
  if (column == nullptr) {
    std::vector<std::string> names;
    for (const Column& known : table.columns) {
      names.push_back(known.name);
    }
    throw InputError(use.place, "column " + model::quote(use.name),
                     "a column of " + table.file + nearest_names(use.name, names));
  }
  return *column;
}

/// The unit of trial.yaml and that of the data file must say the same, where both speak.
std::string declared_unit(const Column& column, const Table& table, const ColumnUse& use) {
  if (use.unit.empty() && column.unit.empty()) {
    throw InputError(
        use.place, "no unit for column " + model::quote(use.name),
        "`unit: " + use.expected_unit + "` or another unit of " + use.owner + "; the data file states none");
  }
  if (use.unit.empty() || column.unit.empty()) {
    return use.unit.empty() ? column.unit : use.unit;
  }
  const bool same = units_agree(use.unit, column.unit) && to_si_factor(use.unit) == to_si_factor(column.unit);
  if (!same) {
    throw InputError(use.place, "unit " + model::quote(use.unit) + " for column " + model::quote(use.name),
                     model::quote(column.unit) + ", which " + table.file + " states");
  }
  return use.unit;
}

/// Takes back the jumps of a column that begins anew after `turn`; a missing cell is stepped over.
void unwrap(double turn, Eigen::VectorXd& values) {
  double last = std::numeric_limits<double>::quiet_NaN();
  for (double& value : values) {
    if (std::isfinite(value)) {
      if (std::isfinite(last)) {
        value -= turn * std::round((value - last) / turn);
      }
      last = value;
    }
  }
}

void refuse_bad_cell(const LogFile& log, const std::string& column, bool may_miss) {
  const auto bad = log.bad.find(column);
  if (bad == log.bad.end() || (bad->second.missing && may_miss)) {
    return;
  }
  const BadCell& cell = bad->second;
  const std::string what = cell.text.empty() ? "an empty field" : model::quote(cell.text);
  const bool has_line = cell.line > 0;
  throw InputError({log.table.file, cell.line, column},
                   has_line ? what : what + " in row " + std::to_string(cell.row),
                   std::string("finite numbers") +
                       (cell.missing ? "; `missing: fill` in trial.yaml bridges missing ones" : ""));
}

/// Absolute times, seconds since 1970 or since a machine was started, are counted from the first row.
constexpr double kAbsolute = 1e7;
constexpr double kMostLeftOut = 0.01;  // share of rows whose time does not rise

}  // namespace

std::string data_path(const TrialFile& file, const std::string& data_folder) {
  if (!data_folder.empty()) {
    return (fs::path(data_folder) / file.data).string();
  }
  if (file.data_folder_env.empty()) {
    return (fs::path(file.folder) / file.data).lexically_normal().string();
  }
  const char* folder = std::getenv(file.data_folder_env.c_str());
  if (folder == nullptr || *folder == '\0') {
    throw InputError(
        file.data_folder_env_place, "the environment variable " + file.data_folder_env + " not set",
        "it to name the folder that holds " + file.data + "; or give the folder with --data DIR");
  }
  return (fs::path(folder) / file.data).string();
}

Signal read_signal(const LogFile& log, const ColumnUse& use, bool may_miss) {
  const Table& table = log.table;
  const Column& column = find_column(table, use);
  Signal signal;
  signal.unit = declared_unit(column, table, use);
  const double factor = unit_factor(signal.unit, use.expected_unit, use.owner,
                                    use.unit.empty() ? Place_in_file{table.file, 1, use.name} : use.place);
  refuse_bad_cell(log, column.name, may_miss);
  signal.values = (factor * use.scale * column.values).array() + use.offset;
  if (use.turn > 0.0) {
    unwrap(use.turn, signal.values);
  }
  const auto too_large = [](double value) { return std::isinf(value); };
  if (std::any_of(signal.values.begin(), signal.values.end(), too_large)) {
    throw InputError({table.file, 0, use.name}, "a number too large for SI", "finite numbers in SI");
  }
  return signal;
}

std::vector<Eigen::Index> rising_rows(const Eigen::VectorXd& time) {
  std::vector<Eigen::Index> ends;  // of the rising rows of each length the last one, as early as can be
  std::vector<Eigen::Index> before(static_cast<std::size_t>(time.size()), -1);
  for (Eigen::Index k = 0; k < time.size(); ++k) {
    if (!std::isfinite(time[k])) {
      continue;
    }
    const auto at = std::lower_bound(ends.begin(), ends.end(), time[k],
                                     [&](Eigen::Index row, double t) { return time[row] < t; });
    before[static_cast<std::size_t>(k)] = at == ends.begin() ? -1 : *(at - 1);
    if (at == ends.end()) {
      ends.push_back(k);
    } else {
      *at = k;
    }
  }
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = ends.empty() ? -1 : ends.back(); k >= 0; k = before[static_cast<std::size_t>(k)]) {
    rows.push_back(k);
  }
  std::reverse(rows.begin(), rows.end());
  constexpr std::size_t kFewest = 3;
  if (rows.size() > kFewest &&
      time[rows.back()] - time[rows[rows.size() - 2]] > time[rows[rows.size() - 2]] - time[rows.front()]) {
    rows.pop_back();
  }
  if (rows.size() > kFewest && time[rows[1]] - time[rows.front()] > time[rows.back()] - time[rows[1]]) {
    rows.erase(rows.begin());
  }
  return rows;
}

RowTimes row_times(const TrialFile& file, const LogFile& log) {
  RowTimes times;
  const Eigen::Index n = log.table.rows();
  if (file.rate > 0.0) {
    times.time = Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1)) / file.rate;
    for (Eigen::Index k = 0; k < n; ++k) {
      times.rows.push_back(k);
    }
    return times;
  }
  const Eigen::VectorXd all = read_signal(log, file.time, file.fill_missing).values;
  const Place_in_file where{log.table.file, 0, file.time.name};
  const auto most = static_cast<Eigen::Index>(kMostLeftOut * static_cast<double>(n));
  Eigen::Index not_rising = 0;
  Eigen::Index without = 0;
  if (file.leave_out_bad_rows) {
    times.rows = rising_rows(all);
    const auto bad = n - static_cast<Eigen::Index>(times.rows.size());
    if (bad > 0) {
      times.remarks.push_back(
          "Left out: " + std::to_string(bad) +
          " rows whose time is missing, far from all others, or not above that of the row "
          "before.");
    }
  }
  for (Eigen::Index k = 0; k < n && !file.leave_out_bad_rows; ++k) {
    if (!std::isfinite(all[k])) {
      ++without;
      continue;
    }
    const double before = times.rows.empty() ? all[k] - 1.0 : all[times.rows.back()];
    if (all[k] > before) {
      times.rows.push_back(k);
      continue;
    }
    if (++not_rising > most) {
      const std::string what = all[k] == before ? "the time of the row before again, " : "time ";
      throw InputError(where, what + seconds(all[k]) + " in " + row_name(k),
                       "a time above " + seconds(before) + " of the row before");
    }
  }
  times.time = kept(all, times.rows);
  if (not_rising > 0) {
    times.remarks.push_back("Left out: " + std::to_string(not_rising) +
                            " rows whose time is not above that of the row before.");
  }
  if (without > 0) {
    times.remarks.push_back("Left out: " + std::to_string(without) + " rows without a time.");
  }
  if (times.time.size() > 0 && std::abs(times.time[0]) > kAbsolute) {
    times.remarks.push_back("Times are absolute: they are counted from the first row, at " +
                            number_text(times.time[0], 15) + " s.");
    times.time.array() -= times.time[0];
  }
  return times;
}

Eigen::VectorXd kept(const Eigen::VectorXd& values, const std::vector<Eigen::Index>& rows) {
  Eigen::VectorXd some(static_cast<Eigen::Index>(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    some[static_cast<Eigen::Index>(i)] = values[rows[i]];
  }
  return some;
}

}  // namespace plumbline::validation
