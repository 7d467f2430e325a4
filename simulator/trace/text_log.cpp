// Text files of numbers in whatever dialect.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/log_file.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline {
namespace {

using Cells = std::vector<std::string_view>;

struct Line {
  int number = 0;
  std::string_view text;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  const std::size_t last = text.find_last_not_of(" \t\r");
  return first == std::string_view::npos ? std::string_view() : text.substr(first, last - first + 1);
}

bool is_missing(std::string_view cell) {
  static const std::set<std::string> words{"",     "nan",  "na",       "n/a",      "null",
                                           "none", "-nan", "nan(ind)", "-nan(ind)"};
  std::string lower(cell);
  std::transform(lower.begin(), lower.end(), lower.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return words.count(lower) != 0;
}

/// How the columns of one file stand apart.
struct Dialect {
  char separator = ',';  ///< ' ': any run of blanks
  bool decimal_comma = false;
};

Cells split(std::string_view line, char separator) {
  Cells cells;
  std::size_t at = 0;
  const auto skip_blanks = [&] {
    while (at < line.size() && (line[at] == ' ' || line[at] == '\t')) {
      ++at;
    }
  };
  if (separator == ' ') {
    line = trimmed(line);
  }
  while (true) {
    if (separator == ' ') {
      skip_blanks();
    }
    const std::size_t begin = at;
    bool in_quotes = false;
    while (at < line.size()) {
      const char c = line[at];
      in_quotes = c == '"' ? !in_quotes : in_quotes;
      const bool ends = separator == ' ' ? c == ' ' || c == '\t' : c == separator;
      if (ends && !in_quotes) {
        break;
      }
      ++at;
    }
    std::string_view cell = trimmed(line.substr(begin, at - begin));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') {
      cell = trimmed(cell.substr(1, cell.size() - 2));
    }
    cells.push_back(cell);
    if (at >= line.size()) {
      return cells;
    }
    ++at;
  }
}

std::optional<double> number_of(std::string_view cell, const Dialect& dialect) {
  if (dialect.decimal_comma && cell.find(',') != std::string_view::npos) {
    std::string pointed(cell);
    std::replace(pointed.begin(), pointed.end(), ',', '.');
    return parse_number(pointed);
  }
  if (const auto value = parse_number(cell)) {
    return value;
  }
  const double instant = timestamp_seconds(cell);
  return std::isfinite(instant) ? std::optional<double>(instant) : std::nullopt;
}

bool is_number_like(std::string_view cell, const Dialect& dialect) {
  return is_missing(cell) || number_of(cell, dialect).has_value();
}

bool is_row(const Cells& cells, const Dialect& dialect) {
  const auto numbers = std::count_if(cells.begin(), cells.end(), [&](std::string_view cell) {
    return number_of(cell, dialect).has_value();
  });
  return numbers > 0;
}

class TextLog {
 public:
  TextLog(std::string path, const std::vector<std::string>& names) : names_(names) {
    log_.table.file = std::move(path);
    text_ = read_text(log_.table.file);
    sort_lines();
  }

  LogFile read() {
    if (lines_.empty()) {
      refuse(1, "an empty file", "a header line and rows of numbers");
    }
    find_dialect();
    std::size_t first = 0;
    if (!names_.empty()) {
      for (const std::string& name : names_) {
        log_.table.columns.push_back({name, "", {}});
      }
    } else {
      first = read_header();
    }
    read_rows(first);
    drop_empty_last_columns();
    return std::move(log_);
  }

 private:
  [[noreturn]] void refuse(int line, const std::string& found, const std::string& expected,
                           const std::string& column = "") const {
    throw InputError({log_.table.file, line, column}, found, expected);
  }

  static bool is_comment(std::string_view line) {
    return line.front() == '#' || line.front() == '%' || line.substr(0, 2) == "//";
  }

  /// Lines with content; comments before the first of them are kept aside: one of them may be the header.
  void sort_lines() {
    std::string_view rest = text_;
    if (rest.substr(0, 3) == "\xEF\xBB\xBF") {
      rest.remove_prefix(3);  // byte order mark of some spreadsheets
    }
    if (rest.find('\0') != std::string_view::npos) {
      refuse(0, "bytes that are no text", "a text file of numbers, or one with the extension of its kind");
    }
    for (int number = 1; !rest.empty(); ++number) {
      const std::size_t end = rest.find_first_of("\r\n");
      const std::string_view line = trimmed(rest.substr(0, end));
      if (!line.empty() && is_comment(line)) {
        if (lines_.empty()) {
          comments_.push_back({number, line});
        }
      } else if (!line.empty()) {
        lines_.push_back({number, rest.substr(0, end)});
      }
      if (end == std::string_view::npos) {
        return;
      }
      const bool two = rest[end] == '\r' && end + 1 < rest.size() && rest[end + 1] == '\n';
      ends_with_line_end_ = end + (two ? 2 : 1) == rest.size();
      rest.remove_prefix(end + (two ? 2 : 1));
    }
  }

  /// The separator that cuts most lines of the beginning into the same number of cells, at least two, and
  /// these into numbers; the stronger sign where two do.
  void find_dialect() {
    constexpr std::size_t kLooked = 50;
    const std::size_t looked = std::min(kLooked, lines_.size());
    std::size_t best = 0;
    for (const char separator : {';', '\t', ',', ' '}) {
      std::size_t agreeing = 0;
      const Cells sample = split(lines_[looked - 1 - (looked > 2 ? 1 : 0)].text, separator);
      const std::size_t usual = sample.size();
      for (std::size_t i = 0; i < looked && usual > 1; ++i) {
        agreeing += split(lines_[i].text, separator).size() == usual ? 1 : 0;
      }
      const Dialect guess{separator, separator != ','};
      if (std::all_of(sample.begin(), sample.end(),
                      [&](std::string_view cell) { return is_number_like(cell, guess); })) {
        agreeing *= 2;
      }
      if (agreeing > best) {
        best = agreeing;
        dialect_.separator = separator;
      }
    }
    if (best == 0) {
      dialect_.separator = lines_.size() > 1 && lines_[1].text.find_first_of(";\t,") != std::string_view::npos
                               ? ','
                               : '\n';  // one column
    }
    if (dialect_.separator != ',') {
      const auto has_comma = [](const Line& line) { return line.text.find(',') != std::string_view::npos; };
      const std::size_t last = looked - 1;
      dialect_.decimal_comma = has_comma(lines_[last]) || (looked > 1 && has_comma(lines_[looked / 2]));
    }
  }

  /// Returns the index of the first row.
  std::size_t read_header() {
    const Cells first = split(lines_.front().text, dialect_.separator);
    if (is_row(first, dialect_)) {
      header_from_comment(first.size());
      return 0;
    }
    for (std::size_t i = 0; i < first.size(); ++i) {
      add_column(first[i], lines_.front().number, i);
    }
    if (lines_.size() > 1) {
      const Cells second = split(lines_[1].text, dialect_.separator);
      if (second.size() == first.size() && is_units(second)) {
        take_units(second);
        return 2;
      }
    }
    return 1;
  }

  void header_from_comment(std::size_t columns) {
    for (auto comment = comments_.rbegin(); comment != comments_.rend(); ++comment) {
      std::string_view text = comment->text;
      text.remove_prefix(std::min(text.find_first_not_of("#%/ \t"), text.size()));
      for (const char separator : {dialect_.separator, ',', ';', '\t', ' '}) {
        const Cells cells = split(text, separator);
        if (cells.size() == columns && !is_row(cells, dialect_)) {
          for (std::size_t i = 0; i < columns; ++i) {
            add_column(cells[i], comment->number, i);
          }
          return;
        }
      }
    }
    for (std::size_t i = 0; i < columns; ++i) {
      log_.table.columns.push_back({"column_" + std::to_string(i + 1), "", {}});
    }
    log_.remarks.emplace_back("The file has no header: its columns are named column_1, column_2, ...");
  }

  static std::string without_brackets(std::string_view cell) {
    const bool bracketed = cell.size() >= 2 && ((cell.front() == '[' && cell.back() == ']') ||
                                                (cell.front() == '(' && cell.back() == ')'));
    return std::string(trimmed(bracketed ? cell.substr(1, cell.size() - 2) : cell));
  }

  static bool is_units(const Cells& cells) {
    return std::all_of(cells.begin(), cells.end(),
                       [](std::string_view cell) {
                         const std::string unit = without_brackets(cell);
                         return unit.empty() || unit == "-" || (unit_is_known(unit) && !parse_number(cell));
                       }) &&
           std::any_of(cells.begin(), cells.end(), [](std::string_view cell) { return !cell.empty(); });
  }

  void take_units(const Cells& cells) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string unit = without_brackets(cells[i]);
      log_.table.columns[i].unit = unit == "-" ? "1" : unit;
    }
  }

  void add_column(std::string_view cell, int line, std::size_t index) {
    Column column;
    column.name = std::string(cell);
    const std::size_t open = cell.find_last_of("[(");
    if (open != std::string_view::npos && open > 0 && (cell.back() == ']' || cell.back() == ')')) {
      const std::string unit(trimmed(cell.substr(open + 1, cell.size() - open - 2)));
      if (unit_is_known(unit) && !(cell[open] == '(' && parse_number(unit))) {
        column.unit = unit;
        column.name = std::string(trimmed(cell.substr(0, open)));
      }
    }
    if (column.name.empty()) {
      column.name = "column_" + std::to_string(index + 1);
    }
    const auto same = [&](const Column& other) { return other.name == column.name; };
    if (std::any_of(log_.table.columns.begin(), log_.table.columns.end(), same)) {
      refuse(line, "this column name twice", "each column name once", column.name);
    }
    log_.table.columns.push_back(std::move(column));
  }

  void read_rows(std::size_t first) {
    const std::size_t columns = log_.table.columns.size();
    std::vector<std::vector<double>> values(columns);
    long row = 0;
    for (std::size_t i = first; i < lines_.size(); ++i) {
      const Cells cells = split(lines_[i].text, dialect_.separator);
      if (cells.size() != columns) {
        if (i + 1 == lines_.size() && !ends_with_line_end_ && row > 0) {
          log_.remarks.push_back("The last line (" + std::to_string(lines_[i].number) +
                                 ") was cut off and is left out.");
          break;
        }
        refuse(lines_[i].number, std::to_string(cells.size()) + " fields",
               std::to_string(columns) + (names_.empty() ? " as in the header" : " as named"));
      }
      ++row;
      for (std::size_t c = 0; c < columns; ++c) {
        const std::optional<double> value = number_of(cells[c], dialect_);
        values[c].push_back(value.value_or(std::numeric_limits<double>::quiet_NaN()));
        if (!value) {
          note_bad_cell(log_.table.columns[c].name,
                        {lines_[i].number, row, std::string(cells[c]), is_missing(cells[c])}, log_);
        }
      }
    }
    if (row == 0) {
      refuse(lines_.back().number, "no rows", "at least one row of numbers behind the header");
    }
    for (std::size_t c = 0; c < columns; ++c) {
      log_.table.columns[c].values =
          Eigen::Map<const Eigen::VectorXd>(values[c].data(), static_cast<Eigen::Index>(values[c].size()));
    }
  }

  /// Rows that end with a separator have a last column without name and content.
  void drop_empty_last_columns() {
    const std::string name = "column_" + std::to_string(log_.table.columns.size());
    const Column& last = log_.table.columns.back();
    if (last.name == name && last.values.array().isNaN().all()) {
      log_.bad.erase(name);
      log_.table.columns.pop_back();
    }
  }

  std::vector<std::string> names_;
  std::string text_;
  std::vector<Line> lines_, comments_;
  bool ends_with_line_end_ = false;
  Dialect dialect_;
  LogFile log_;
};

}  // namespace

void note_bad_cell(const std::string& column, const BadCell& cell, LogFile& log) {
  const auto known = log.bad.find(column);
  if (known == log.bad.end()) {
    log.bad.emplace(column, cell);
  } else if (known->second.missing && !cell.missing) {
    known->second = cell;
  }
}

LogFile read_text_log(const std::string& path, const std::vector<std::string>& names) {
  return TextLog(path, names).read();
}

}  // namespace plumbline
