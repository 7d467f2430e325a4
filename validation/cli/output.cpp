#include "validation/cli/output.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "simulator/trace/table.h"

namespace plumbline::cli {

void print_table(const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> width(head.size());
  for (std::size_t c = 0; c < head.size(); ++c) {
    width[c] = head[c].size();
    for (const auto& row : rows) {
      width[c] = std::max(width[c], row[c].size());
    }
  }
  const auto line = [&](const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      text += c + 1 == cells.size() ? cells[c] : fmt::format("{:<{}}  ", cells[c], width[c]);
    }
    fmt::print("  {}\n", text);
  };
  line(head);
  std::vector<std::string> rule;
  rule.reserve(width.size());
  for (const std::size_t w : width) {
    rule.emplace_back(w, '-');
  }
  line(rule);
  for (const auto& row : rows) {
    line(row);
  }
}

void write_json(const nlohmann::json& json, const std::string& file) {
  if (!file.empty()) {
    write_text_atomically(file, json.dump(2) + "\n");
  }
}

ProgressLine::ProgressLine()
    : terminal_(isatty(STDERR_FILENO) != 0), start_(std::chrono::steady_clock::now()), part_start_(start_) {}

ProgressLine::~ProgressLine() {
  if (terminal_) {
    fmt::print(stderr, "\r\033[K");
  }
}

validation::Progress ProgressLine::callback() {
  return [this](const std::string& what, double fraction) { show(what, fraction); };
}

void ProgressLine::show(const std::string& what, double fraction) {
  if (!terminal_) {
    return;
  }
  const auto now = std::chrono::steady_clock::now();
  if (fraction < last_fraction_) {
    part_start_ = now;
  }
  last_fraction_ = fraction;
  const double spent = std::chrono::duration<double>(now - start_).count();
  const double part = std::chrono::duration<double>(now - part_start_).count();
  const std::string left =
      fraction > 0.05 ? fmt::format(", about {:.0f} s left in this step", part * (1.0 - fraction) / fraction)
                      : "";
  fmt::print(stderr, "\r\033[K[{:.0f} s] {}{}", spent, what, left);
  std::fflush(stderr);
}

}  // namespace plumbline::cli
