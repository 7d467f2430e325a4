#include <charconv>
#include <cstdio>
#include <set>

#include "simulator/model/plain_number.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "validation/batch/jobs.h"

namespace plumbline::batch {
namespace {

using model::YamlNode;

const std::vector<std::string> kCommon{"mode", "model", "data", "window", "free", "without", "most"};

std::vector<std::string> texts(const YamlNode& node) {
  std::vector<std::string> all;
  for (const YamlNode& item : node.items()) {
    all.push_back(item.text());
  }
  return all;
}

std::vector<std::string> names_with(std::vector<std::string> more) {
  more.insert(more.end(), kCommon.begin(), kCommon.end());
  return more;
}

Mode mode_of(const YamlNode& node) {
  for (const Mode mode : {Mode::diagnose, Mode::compare, Mode::fit}) {
    if (node.text() == to_string(mode)) {
      return mode;
    }
  }
  node.refuse("diagnose, compare or fit");
}

int effects_of(const YamlNode& node) {
  constexpr double kMost = 100.0;
  const double number = node.number();
  if (!(number >= 1.0 && number <= kMost && number == static_cast<int>(number))) {
    node.refuse("a whole number from 1 to 100");
  }
  return static_cast<int>(number);
}

/// What may stand in a row, or beside the rows for all of them.
void read_common(const YamlNode& node, Row& row) {
  if (const auto mode = node.find("mode")) {
    row.mode = mode_of(*mode);
  }
  if (const auto file = node.find("model")) {
    row.model = model::beside(node.file(), file->text());
  }
  if (const auto folder = node.find("data")) {
    row.data_folder = model::beside(node.file(), folder->text());
  }
  if (const auto window = node.find("window")) {
    row.window = model::read_positive(*window, "s");
  }
  if (const auto free = node.find("free")) {
    row.free = texts(*free);
  }
  if (const auto without = node.find("without")) {
    row.without = texts(*without);
  }
  if (const auto most = node.find("most")) {
    row.most = effects_of(*most);
  }
}

bool is_file_name(const std::string& text) {
  return text.front() != '.' &&
         text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-") ==
             std::string::npos;
}

std::optional<double> number_of(const std::string& text) {
  double number = 0.0;
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, number);
  return read.ec == std::errc() && read.ptr == end ? std::optional<double>(number) : std::nullopt;
}

/// What a row is called when it does not say: its robot and day.
std::string default_label(const Row& row, std::size_t index) {
  const std::string joint = row.robot.empty() || row.day.empty() ? "" : "_";
  const std::string name = row.robot + joint + row.day;
  return name.empty() ? "row-" + std::to_string(index + 1) : name;
}

Row read_row(const YamlNode& node, const Row& common, std::size_t index) {
  node.allow_keys(names_with({"label", "robot", "day", "trials"}));
  Row row = common;
  read_common(node, row);
  if (const auto robot = node.find("robot")) {
    row.robot = robot->text();
  }
  if (const auto day = node.find("day")) {
    row.day = day->text();
    row.day_count = days_of(row.day) ? days_of(row.day) : number_of(row.day);
    if (!row.day_count) {
      day->refuse("a date such as 2026-03-14, or a number of days");
    }
  }
  const auto label = node.find("label");
  row.label = label ? label->text() : default_label(row, index);
  if (!is_file_name(row.label)) {
    (label ? *label : node)
        .refuse(model::quote(row.label), "a label of letters, digits, \".\", \"_\" and \"-\"");
  }
  for (const std::string& trial : texts(node.at("trials"))) {
    row.trials.push_back(model::beside(node.file(), trial));
  }
  if (row.trials.empty()) {
    node.at("trials").refuse("one trial at least");
  }
  if (row.mode == Mode::fit && row.free.empty()) {
    node.refuse("mode fit without free", "free: patterns of the parameters to fit");
  }
  return row;
}

}  // namespace

std::string to_string(Mode mode) {
  switch (mode) {
    case Mode::compare:
      return "compare";
    case Mode::fit:
      return "fit";
    case Mode::diagnose:
      break;
  }
  return "diagnose";
}

// Howard Hinnant, "chrono-compatible low-level date algorithms", days_from_civil.
std::optional<double> days_of(const std::string& date) {
  int year = 0, month = 0, day = 0, read = 0;
  constexpr int kLength = 10;
  if (date.size() != kLength || std::sscanf(date.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &read) != 3 ||
      read != kLength || year < 1 || month < 1 || month > 12 || day < 1) {
    return std::nullopt;
  }
  const bool is_leap = (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
  const int february = is_leap ? 29 : 28;
  const bool is_short = month == 4 || month == 6 || month == 9 || month == 11;
  if (day > (month == 2 ? february : is_short ? 30 : 31)) {
    return std::nullopt;
  }
  const int y = month <= 2 ? year - 1 : year;
  const int era = y / 400, of_era = y - era * 400;
  const int of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;
  return 146097.0 * era + 365.0 * of_era + of_era / 4 - of_era / 100 + of_year - 719468.0;
}

Jobs read_jobs(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "batch/1");
  root.allow_keys(names_with({"plumbline", "title", "rows"}));
  Jobs jobs{path, root.at("title").text(), {}};
  Row common;
  read_common(root, common);
  std::set<std::string> labels;
  const std::vector<YamlNode> rows = root.at("rows").items();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    jobs.rows.push_back(read_row(rows[i], common, i));
    if (!labels.insert(jobs.rows.back().label).second) {
      rows[i].refuse("a second row " + model::quote(jobs.rows.back().label), "a label of its own");
    }
  }
  if (jobs.rows.empty()) {
    root.at("rows").refuse("one row at least");
  }
  return jobs;
}

}  // namespace plumbline::batch
