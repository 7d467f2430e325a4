// CSV through libcsv: its callbacks give fields and row ends, and from the row ends follow the lines.
#include <csv.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"

namespace plumbline {
namespace {

constexpr int kLineFeed = '\n';
constexpr int kCarriageReturn = '\r';

/// Takes libcsv's events. Errors are kept, not thrown, because an exception must not cross C code.
class CsvEvents {
 public:
  explicit CsvEvents(std::string file) : file_(std::move(file)) {}

  /// The file has no header: its columns have these names and no units.
  CsvEvents(std::string file, const std::vector<std::string>& names)
      : file_(std::move(file)), in_header_(false), has_header_(false) {
    for (const std::string& name : names) {
      columns_.push_back({name, "", {}});
    }
    values_.resize(columns_.size());
  }

  void field(std::string_view text) {
    if (!error_) {
      line_has_fields_ = true;
      in_header_ ? header_field(text) : number_field(text);
      line_ += static_cast<int>(std::count(text.begin(), text.end(), '\n'));  // inside quotes
    }
  }

  void row_end(int terminator) {
    const bool second_half =
        terminator == kLineFeed && last_terminator_ == kCarriageReturn && !line_has_fields_;
    last_terminator_ = line_has_fields_ || !second_half ? terminator : 0;
    if (second_half || error_) {
      return;
    }
    if (line_has_fields_) {
      end_row();
    } else if (first_empty_line_ == 0 && (has_header_ || rows_ > 0)) {
      first_empty_line_ = line_;
    }
    line_has_fields_ = false;
    ++line_;
  }

  void refuse(const std::string& found, const std::string& expected, const std::string& column = "") {
    if (!error_) {
      error_ = InputError({file_, line_, column}, found, expected);
    }
  }

  bool failed() const { return error_.has_value(); }

  Table table() {
    if (!error_ && in_header_) {
      line_ = 1;
      refuse("an empty file", "a header line `name [unit],...`");
    } else if (!error_ && rows_ == 0) {
      refuse("no rows", has_header_ ? "at least one row of numbers behind the header" : "rows of numbers");
    }
    if (error_) {
      throw InputError(*error_);
    }
    Table table;
    table.file = file_;
    table.columns = std::move(columns_);
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      table.columns[i].values =
          Eigen::Map<const Eigen::VectorXd>(values_[i].data(), static_cast<Eigen::Index>(values_[i].size()));
    }
    return table;
  }

 private:
  void header_field(std::string_view text) {
    const std::size_t open = text.find('[');
    const std::size_t close = text.rfind(']');
    Column column;
    column.name = trimmed(text.substr(0, std::min(open, text.size())));
    if (column.name.empty()) {
      return refuse(quoted(text), "a column `name [unit]`", "column " + std::to_string(columns_.size() + 1));
    }
    if (open == std::string_view::npos || close == std::string_view::npos || close < open ||
        close + 1 != text.size()) {
      return refuse(quoted(text), "`name [unit]`", column.name);
    }
    column.unit = trimmed(text.substr(open + 1, close - open - 1));
    if (!unit_is_known(column.unit)) {
      return refuse("unit " + quoted(column.unit), "a unit such as s, rad, N m, V or 1", column.name);
    }
    const auto same = [&](const Column& other) { return other.name == column.name; };
    if (std::any_of(columns_.begin(), columns_.end(), same)) {
      return refuse("this column name twice", "each column name once", column.name);
    }
    columns_.push_back(std::move(column));
  }

  void number_field(std::string_view text) {
    if (fields_in_row_ < columns_.size()) {
      const std::optional<double> value = parse_number(text);
      if (!value) {
        return refuse(text.empty() ? "an empty field" : quoted(text), "a finite number",
                      columns_[fields_in_row_].name);
      }
      values_[fields_in_row_].push_back(*value);
    }
    ++fields_in_row_;
  }

  void end_row() {
    if (in_header_) {
      values_.resize(columns_.size());
      in_header_ = false;
      if (first_empty_line_ != 0) {
        line_ = first_empty_line_;
        refuse("an empty line", "a header line `name [unit],...`");
      }
      return;
    }
    if (first_empty_line_ != 0) {
      line_ = first_empty_line_;
      return refuse("an empty line between rows", "numbers");
    }
    if (fields_in_row_ != columns_.size()) {
      return refuse(std::to_string(fields_in_row_) + " fields",
                    std::to_string(columns_.size()) + (has_header_ ? " as in the header" : " as named"));
    }
    fields_in_row_ = 0;
    ++rows_;
  }

  static std::string trimmed(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    const std::size_t last = text.find_last_not_of(" \t");
    return first == std::string_view::npos ? "" : std::string(text.substr(first, last - first + 1));
  }

  static std::string quoted(std::string_view text) { return "\"" + std::string(text) + "\""; }

  std::string file_;
  std::optional<InputError> error_;
  std::vector<Column> columns_;
  std::vector<std::vector<double>> values_;
  std::size_t fields_in_row_ = 0;
  long rows_ = 0;
  int line_ = 1;
  int first_empty_line_ = 0;
  int last_terminator_ = 0;
  bool in_header_ = true;
  bool has_header_ = true;
  bool line_has_fields_ = false;
};

void on_field(void* text, std::size_t size, void* events) {
  static_cast<CsvEvents*>(events)->field({static_cast<const char*>(text), size});
}

void on_row_end(int terminator, void* events) { static_cast<CsvEvents*>(events)->row_end(terminator); }

/// Owns libcsv's parser.
class CsvParser {
 public:
  CsvParser() {
    constexpr unsigned char options = CSV_STRICT | CSV_STRICT_FINI | CSV_REPALL_NL;
    if (csv_init(&parser_, options) != 0) {
      throw std::runtime_error("libcsv cannot start");
    }
  }
  ~CsvParser() { csv_free(&parser_); }
  CsvParser(const CsvParser&) = delete;
  CsvParser& operator=(const CsvParser&) = delete;

  void run(std::string_view text, CsvEvents& events) {
    constexpr std::size_t chunk = std::size_t{1} << 16U;
    for (std::size_t at = 0; at < text.size() && !events.failed(); at += chunk) {
      const std::string_view part = text.substr(at, chunk);
      if (csv_parse(&parser_, part.data(), part.size(), on_field, on_row_end, &events) != part.size()) {
        return events.refuse("a quotation mark inside a field", "numbers");
      }
    }
    if (!events.failed() && csv_fini(&parser_, on_field, on_row_end, &events) != 0) {
      events.refuse("an open quotation mark at the end of the file", "numbers");
    }
  }

 private:
  csv_parser parser_{};
};

Table parsed(const std::string& path, CsvEvents events) {
  const std::string text = read_text(path);
  std::string_view content = text;
  if (content.substr(0, 3) == "\xEF\xBB\xBF") {
    content.remove_prefix(3);  // byte order mark of some spreadsheets
  }
  CsvParser().run(content, events);
  return events.table();
}

std::string header_text(const Table& table) {
  std::string text;
  for (const Column& column : table.columns) {
    if (column.name.empty() || column.unit.empty()) {
      throw std::invalid_argument("column \"" + column.name +
                                  "\" has no name or no unit and cannot go to CSV");
    }
    if (column.values.size() != table.rows()) {
      throw std::invalid_argument("column \"" + column.name + "\" is not as long as the first");
    }
    if (column.name.find_first_of("\",[]\r\n") != std::string::npos) {
      throw std::invalid_argument("column name \"" + column.name + "\" holds a comma, quote or bracket");
    }
    text += (text.empty() ? "" : ",") + column.name + " [" + column.unit + "]";
  }
  return text + "\n";
}

}  // namespace

Table read_csv(const std::string& path) { return parsed(path, CsvEvents(path)); }

Table read_headerless_csv(const std::string& path, const std::vector<std::string>& names) {
  return parsed(path, CsvEvents(path, names));
}

void write_csv(const Table& table, const std::string& path, int digits) {
  std::string text = header_text(table);
  for (Eigen::Index row = 0; row < table.rows(); ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      text += (i == 0 ? "" : ",") + number_text(table.columns[i].values[row], digits);
    }
    text += '\n';
  }
  write_text_atomically(path, text);
}

}  // namespace plumbline
