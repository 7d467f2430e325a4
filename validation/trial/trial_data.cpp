#include "validation/trial/trial_data.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"
#include "validation/trial/physical_number.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

constexpr Eigen::Index kFewestSamples = 20;
constexpr double kUniform = 0.01;
constexpr int kDigits = 9;  // enough to see the difference of two sample times

std::string seconds(double value) { return number_text(value, kDigits) + " s"; }

std::string row_name(Eigen::Index index) { return "row " + std::to_string(index + 1); }

const Column& find_column(const Table& table, const ColumnUse& use) {
  const Column* column = table.find(use.name);
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

double median_step(const Eigen::VectorXd& time) {
  const Eigen::Index n = time.size() - 1;
  std::vector<double> steps(static_cast<std::size_t>(n));
  for (Eigen::Index k = 0; k < n; ++k) {
    steps[static_cast<std::size_t>(k)] = time[k + 1] - time[k];
  }
  const auto middle = steps.begin() + n / 2;
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

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

Signal read_signal(const Table& table, const ColumnUse& use) {
  const Column& column = find_column(table, use);
  Signal signal;
  signal.unit = declared_unit(column, table, use);
  const double factor = unit_factor(signal.unit, use.expected_unit, use.owner,
                                    use.unit.empty() ? Place_in_file{table.file, 1, use.name} : use.place);
  require_finite(table, use.name);
  signal.values = factor * column.values;
  if (!signal.values.allFinite()) {
    throw InputError({table.file, 0, use.name}, "a number too large for SI", "finite numbers in SI");
  }
  return signal;
}

double checked_period(const Eigen::VectorXd& time, const Table& table, const std::string& column) {
  const Place_in_file where{table.file, 0, column};
  const Eigen::Index n = time.size();
  if (n < kFewestSamples) {
    throw InputError(where, std::to_string(n) + " samples",
                     "at least " + std::to_string(kFewestSamples) + " samples");
  }
  for (Eigen::Index k = 1; k < n; ++k) {
    if (!(time[k] > time[k - 1])) {
      const std::string what = time[k] == time[k - 1] ? "the time of the row before again, " : "time ";
      throw InputError(where, what + seconds(time[k]) + " in " + row_name(k),
                       "a time above " + seconds(time[k - 1]) + " of the row before");
    }
  }
  const double usual = median_step(time);
  for (Eigen::Index k = 1; k < n; ++k) {
    const double step = time[k] - time[k - 1];
    if (std::abs(step - usual) > kUniform * usual) {
      throw InputError(where,
                       "a step of " + seconds(step) + " from " + seconds(time[k - 1]) + " to " +
                           seconds(time[k]) + " in " + row_name(k),
                       "steps within 1 % of the usual " + seconds(usual));
    }
  }
  return (time[n - 1] - time[0]) / static_cast<double>(n - 1);
}

}  // namespace plumbline::validation
