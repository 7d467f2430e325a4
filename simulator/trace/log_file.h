// Logs as people have them: what a reader of a trial, and whoever looks at an unknown file, get from one.
#pragma once

#include <map>
#include <set>
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
      bad;                            ///< by column: the first cell that is more than missing, else the first
  std::vector<std::string> remarks;   ///< what was understood or left out, a sentence each
  std::vector<std::string> topics{};  ///< of a bag: columns begin with one of these; rows are the first one's
};

struct LogQuestion {
  std::vector<std::string> names{};  ///< of the columns of a text file without a header
  std::vector<std::string>
      wanted{};  ///< HDF5 and MATLAB: these alone, of one length; empty: the longest ones. Bags: see read_bag
  std::vector<std::string> topics{};  ///< of a bag, besides those of wanted columns
  std::set<std::string> held{};       ///< columns whose values last until the next, where topics are joined
};

/// By what the file is (its first bytes, then its extension):
/// - text (.csv, .txt, .tsv, .log, .dat): see read_text_log,
/// - JSON lines (.jsonl, .ndjson), or a .json that is a list of objects or an object of lists,
/// - HDF5 (.h5, .hdf5): every dataset of numbers with one or two dimensions, named by its path without the
///   first slash; a matrix gives PATH_1, PATH_2 ..., a compound PATH.FIELD,
/// - MATLAB (.mat),
/// - rosbag2 (.db3) and MCAP (.mcap): see read_bag in bag.h; or the folder of a bag with one such file.
/// Throws InputError (file, line, column) for what cannot be read.
LogFile read_log(const std::string& path, const LogQuestion& question = {});

/// Has the file topics: .mcap, .db3, or a folder, which only bags are.
bool is_bag(const std::string& path);

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

/// rosbag2's sqlite3 storage.
LogFile read_rosbag_log(const std::string& path, const LogQuestion& question);

/// MCAP (mcap.dev/spec, version 0): through the chunk index of its summary, or from end to end where it has
/// none; chunks as they are, in lz4 or zstd. Checked where the file has them: CRCs of summary, of the chunks
/// that are read and, from end to end, of all data. Throws InputError (file, byte) for a file that was cut
/// off or breaks the format.
LogFile read_mcap_log(const std::string& path, const LogQuestion& question);

/// Seconds since 1970-01-01 of an instant as ISO 8601 writes it (date, `T` or blank, time, perhaps Z or an
/// offset; without one UTC); NaN when the text is none.
double timestamp_seconds(std::string_view text);

/// Notes a cell that is no finite number.
void note_bad_cell(const std::string& column, const BadCell& cell, LogFile& log);

}  // namespace plumbline
