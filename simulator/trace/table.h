// Named columns with units: what physics, logs, comparison and drawing all read.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace plumbline {

struct Column {
  std::string name;
  std::string unit;  ///< as in the file; empty when the file has none (MATLAB)
  Eigen::VectorXd values;
};

struct Table {
  std::string file;  ///< where it came from, for messages
  std::vector<Column> columns;

  const Column* find(const std::string& name) const;
  Eigen::Index rows() const { return columns.empty() ? 0 : columns.front().values.size(); }
};

/// CSV with header `name [unit]`. Refuses: duplicate or empty names, missing units, ragged rows, text, NaN,
/// infinity, no rows. Messages name file, line and column.
Table read_csv(const std::string& path);

/// Rows of numbers without a header, separated by commas, under the given names; units are empty: the trial
/// states them. Empty lines before the first row are skipped. Any file name extension. Refuses what read_csv
/// refuses.
Table read_headerless_csv(const std::string& path, const std::vector<std::string>& names);

/// MATLAB v5 or v7.3 (matio): every real vector or matrix variable; a matrix gives columns name_1, name_2 ...
/// Kept are those of the longest length (two rows at least); scalars, shorter vectors, texts, cells,
/// structures, complex and logical arrays are skipped. Units are empty: the trial states them. NaN and
/// infinity are refused by require_finite, column by column.
Table read_mat(const std::string& path);

/// Throws InputError when the column is missing (with the nearest names) or holds NaN or infinity (with the
/// row).
void require_finite(const Table& table, const std::string& column);

/// By extension (.csv, .mat). Throws InputError on anything else.
Table read_table(const std::string& path);

/// Writes to a temporary file beside `path` and renames it: nothing half-written. Enough digits to read back
/// the same doubles when digits is 17.
void write_csv(const Table& table, const std::string& path, int digits = 10);
void write_mat(const Table& table, const std::string& path);

/// Writes text so that `path` has the old content or the whole new one.
void write_text_atomically(const std::string& path, const std::string& text);

}  // namespace plumbline
