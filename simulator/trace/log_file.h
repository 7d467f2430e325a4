// Logs as people have them: what a reader of a trial, and whoever looks at an unknown file, get from one.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/trace/table.h"

namespace plumbline {

/// A cell that is no finite number.
struct BadCell {
  int line = 0;         ///< 0: the file has no lines
  long row = 0;         ///< 1 is the first of the data
  std::string text;     ///< as it stands there
  bool missing = true;  ///< empty, nan, null: a sample that was not taken; otherwise text or an infinity
};

struct LogFile {
  Table table;  ///< NaN where a cell is no finite number; units may be empty
  std::map<std::string, BadCell>
      bad;                           ///< by column: the first cell that is more than missing, else the first
  std::vector<std::string> remarks;  ///< what was understood or left out, a sentence each
};

struct LogQuestion {
  std::vector<std::string> names{};  ///< of the columns of a text file without a header
  std::vector<std::string>
      wanted{};  ///< HDF5 and MATLAB: these alone, of one length; empty: the longest ones
};

/// By what the file is (its first bytes, then its extension):
/// - text (.csv, .txt, .tsv, .log, .dat): see read_text_log,
/// - JSON lines (.jsonl, .ndjson), or a .json that is a list of objects or an object of lists,
/// - HDF5 (.h5, .hdf5): every dataset of numbers with one or two dimensions, named by its path without the
///   first slash; a matrix gives PATH_1, PATH_2 ..., a compound PATH.FIELD,
/// - MATLAB (.mat),
/// - rosbag2 (.db3): see read_rosbag_log.
/// Throws InputError (file, line, column) for what cannot be read.
LogFile read_log(const std::string& path, const LogQuestion& question = {});

/// Numbers in columns, in any of these dialects: separated by commas, semicolons, tabs or blanks (found by
/// looking); decimal points, or decimal commas beside another separator; lines that begin with #, % or // are
/// comments; a header of `name`, `name [unit]` or `name (unit)`, perhaps behind a comment sign, perhaps with
/// the units in a line of their own; without a header `names`, or else column_1, column_2 ...; empty lines;
/// byte order mark; quotation marks; instants as 2024-05-01T12:00:00.25Z, which become seconds since 1970; a
/// last line that was cut off. Throws InputError for columns of one name, rows of another length, no rows.
LogFile read_text_log(const std::string& path, const std::vector<std::string>& names = {});

/// One object to a line; what is nested is named outer.inner, items of a list outer.1, outer.2 ... Keys that
/// a line has not are missing cells.
LogFile read_json_log(const std::string& path);

LogFile read_hdf5_log(const std::string& path, const std::vector<std::string>& wanted);

/// rosbag2's sqlite3 storage: the topic that `wanted` columns begin with (empty: the only one that can be
/// read), columns TOPIC.FIELD and TOPIC.log_time, the receipt. Throws InputError with the list of topics.
LogFile read_rosbag_log(const std::string& path, const std::vector<std::string>& wanted);

/// Seconds since 1970-01-01 of an instant as ISO 8601 writes it (date, `T` or blank, time, perhaps Z or an
/// offset; without one UTC); NaN when the text is none.
double timestamp_seconds(std::string_view text);

/// Notes a cell that is no finite number.
void note_bad_cell(const std::string& column, const BadCell& cell, LogFile& log);

}  // namespace plumbline
