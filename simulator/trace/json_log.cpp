// JSON lines, and JSON files that are one list of objects or one object of lists.
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/log_file.h"

namespace plumbline {
namespace {

using nlohmann::json;

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// Collects records into columns; what a record has not is a missing cell.
class JsonCollector {
 public:
  explicit JsonCollector(const std::string& path) { log_.table.file = path; }

  void add(const json& record, int line) {
    line_ = line;
    ++rows_;
    flatten("", record);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (values_[i].size() < static_cast<std::size_t>(rows_)) {
        values_[i].push_back(kNoNumber);
        note_bad_cell(log_.table.columns[i].name, {line_, rows_, "", true}, log_);
      }
    }
  }

  LogFile result() {
    if (rows_ == 0 || values_.empty()) {
      throw InputError({log_.table.file, 0, ""}, "no records with numbers",
                       "JSON lines: one object with numbers on each line");
    }
    for (std::size_t i = 0; i < values_.size(); ++i) {
      log_.table.columns[i].values =
          Eigen::Map<const Eigen::VectorXd>(values_[i].data(), static_cast<Eigen::Index>(values_[i].size()));
    }
    return std::move(log_);
  }

 private:
  void flatten(const std::string& name, const json& value) {
    if (value.is_object()) {
      for (const auto& [key, inner] : value.items()) {
        flatten(name.empty() ? key : name + "." + key, inner);
      }
    } else if (value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) {
        flatten((name.empty() ? "" : name + ".") + std::to_string(i + 1), value[i]);
      }
    } else {
      store(name.empty() ? "value" : name, value);
    }
  }

  void store(const std::string& name, const json& value) {
    std::size_t at = 0;
    while (at < values_.size() && log_.table.columns[at].name != name) {
      ++at;
    }
    if (at == values_.size()) {
      log_.table.columns.push_back({name, "", {}});
      values_.emplace_back(static_cast<std::size_t>(rows_ - 1), kNoNumber);
      if (rows_ > 1) {
        note_bad_cell(name, {0, 1, "", true}, log_);
      }
    }
    double number = kNoNumber;
    if (value.is_number()) {
      number = value.get<double>();
    } else if (value.is_boolean()) {
      number = value.get<bool>() ? 1.0 : 0.0;
    } else if (value.is_string()) {
      number = timestamp_seconds(value.get<std::string>());
    }
    if (!std::isfinite(number)) {
      note_bad_cell(name, {line_, rows_, value.dump(), value.is_null()}, log_);
      number = kNoNumber;
    }
    values_[at].resize(static_cast<std::size_t>(rows_), kNoNumber);
    values_[at].back() = number;
  }

  LogFile log_;
  std::vector<std::vector<double>> values_;
  long rows_ = 0;
  int line_ = 0;
};

json parsed(const std::string& text, const std::string& path, int line) {
  json value = json::parse(text, nullptr, false);
  if (value.is_discarded()) {
    throw InputError({path, line, ""}, "text that is no JSON", "an object such as {\"t\": 0.1, \"q\": 0.2}");
  }
  return value;
}

/// {"t": [...], "q": [...]}: the lists' items are the rows.
bool is_object_of_lists(const json& value) {
  if (!value.is_object() || value.empty()) {
    return false;
  }
  for (const auto& [key, inner] : value.items()) {
    if (inner.is_array() && inner.size() > 1) {
      return true;
    }
  }
  return false;
}

void add_lists(const json& lists, JsonCollector& collector) {
  std::size_t longest = 0;
  for (const auto& [key, list] : lists.items()) {
    longest = std::max(longest, list.is_array() ? list.size() : std::size_t{0});
  }
  for (std::size_t row = 0; row < longest; ++row) {
    json record;
    for (const auto& [key, list] : lists.items()) {
      if (list.is_array() && list.size() == longest) {
        record[key] = list[row];
      }
    }
    collector.add(record, 0);
  }
}

}  // namespace

LogFile read_json_log(const std::string& path) {
  const std::string text = read_text(path);
  JsonCollector collector(path);
  const json whole = json::parse(text, nullptr, false);
  if (whole.is_array()) {
    for (const json& record : whole) {
      collector.add(record, 0);
    }
    return collector.result();
  }
  if (is_object_of_lists(whole)) {
    add_lists(whole, collector);
    return collector.result();
  }
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) {
      continue;
    }
    const bool cut_off = lines.eof() && number > 1 && !json::accept(line);
    if (!cut_off) {  // the last line of a log whose power went off
      collector.add(parsed(line, path, number), number);
    }
  }
  return collector.result();
}

}  // namespace plumbline
