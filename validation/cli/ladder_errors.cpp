#include "validation/cli/ladder_errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using validation::ChannelError;
using validation::LostWindow;
using validation::PhaseError;

/// Mean of squares, collected under a row's name and for each model.
struct Cell {
  double sum = 0.0, weight = 0.0;
  void add(double value, double w) {
    sum += w * value * value;
    weight += w;
  }
};

struct ErrorRow {
  std::vector<std::string> names;
  std::vector<Cell> cells;  ///< by model
};

/// The rows in the order in which their names first came.
class ErrorTable {
 public:
  explicit ErrorTable(std::size_t models) : models_(models) {}

  void add(const std::vector<std::string>& names, std::size_t model, double value, double weight = 1.0) {
    auto row =
        std::find_if(rows_.begin(), rows_.end(), [&](const ErrorRow& one) { return one.names == names; });
    if (row == rows_.end()) {
      rows_.push_back({names, std::vector<Cell>(models_)});
      row = rows_.end() - 1;
    }
    row->cells[model].add(value, weight);
  }

  void print(const std::string& title, std::vector<std::string> head) const {
    if (rows_.empty()) {
      return;
    }
    for (std::size_t m = 0; m < models_; ++m) {
      head.push_back(fmt::format("({})", m + 1));
    }
    std::vector<std::vector<std::string>> texts;
    for (const ErrorRow& row : rows_) {
      texts.push_back(row.names);
      for (const Cell& cell : row.cells) {
        texts.back().push_back(cell.weight > 0.0 ? fmt::format("{:.3g}", std::sqrt(cell.sum / cell.weight))
                                                 : "-");
      }
    }
    fmt::print("\n{}\n\n", title);
    print_table(head, texts);
  }

 private:
  std::size_t models_;
  std::vector<ErrorRow> rows_;
};

void print_lost(const std::vector<api::LadderRung>& rungs) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t m = 0; m < rungs.size(); ++m) {
    const std::vector<LostWindow>& lost = rungs[m].windows.lost;
    if (!lost.empty()) {
      const LostWindow& first = lost.front();
      rows.push_back({fmt::format("({})", m + 1), std::to_string(lost.size()),
                      fmt::format("{}, {:.2f} to {:.2f} s", first.trial, first.from, first.to),
                      first.reason});
    }
  }
  if (!rows.empty()) {
    fmt::print(
        "\nLeft out, because a model cannot be integrated there. Its errors are over fewer windows:\n\n");
    print_table({"model", "windows", "the first", "because"}, rows);
  }
}

}  // namespace

void print_errors(const std::vector<api::LadderRung>& rungs) {
  ErrorTable trials(rungs.size()), phases(rungs.size()), channels(rungs.size());
  for (std::size_t m = 0; m < rungs.size(); ++m) {
    for (const ChannelError& c : rungs[m].windows.channels) {
      trials.add({c.trial, to_string(c.role)}, m, c.ratio);
      channels.add({c.name, to_string(c.role), c.unit}, m, c.rms);
    }
    for (const PhaseError& p : rungs[m].windows.phases) {
      phases.add({p.phase.group, p.phase.name}, m, p.ratio, p.share);
    }
  }
  trials.print("Each trial, in units of the floor (root mean square over its channels):", {"trial", "role"});
  phases.print("Each phase of the motion, in units of the floor (over all trials and channels):",
               {"phases by", "phase"});
  channels.print("Each channel (root mean square of measured less predicted, over the trials of a role):",
                 {"channel", "role", "unit"});
  print_lost(rungs);
}

}  // namespace plumbline::cli
