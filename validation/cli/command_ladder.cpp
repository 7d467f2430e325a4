#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "validation/api/ladder.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/ladder_errors.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

using validation::LoopError;
using validation::NeededForce;
using validation::ReferenceValue;
using validation::WholeTrial;

constexpr double kWorthSaying = 0.005;  // share by which a recorded disturbance may differ from its column

struct LadderInputs {
  Inputs inputs;
  std::vector<std::string> models;
};

/// One column of errors in %: a quantity of a trial, and of a motor where the trial has several.
struct ErrorColumn {
  std::string head;
  std::string data;
  ReferenceValue::Quantity quantity;
  std::size_t trial, item;
};

std::optional<double> value_of(const api::LadderRung& rung, const ErrorColumn& column) {
  const WholeTrial& trial = rung.trials[column.trial];
  if (column.quantity == ReferenceValue::Quantity::inverse_force) {
    return column.item < trial.inverse.motors.size()
               ? std::optional<double>(trial.inverse.motors[column.item].error_percent())
               : std::nullopt;
  }
  if (column.item >= trial.loop.loops.size()) {
    return std::nullopt;
  }
  const LoopError& error = trial.loop.loops[column.item];
  return column.quantity == ReferenceValue::Quantity::closed_loop_position ? error.position_percent
                                                                           : error.force_percent;
}

/// The longest of a trial's result lists over all models: what one model lacks another may have.
template <typename Item, typename List>
std::vector<Item> longest(const std::vector<api::LadderRung>& rungs, std::size_t trial, const List& list_of) {
  std::vector<Item> longest;
  for (const api::LadderRung& rung : rungs) {
    const std::vector<Item>& items = list_of(rung.trials[trial]);
    longest = items.size() > longest.size() ? items : longest;
  }
  return longest;
}

/// Columns that any of the models can fill. "[2] force mLA": trial 2, motor mLA (named where there are
/// several).
std::vector<ErrorColumn> error_columns(const std::vector<api::LadderRung>& rungs) {
  using Quantity = ReferenceValue::Quantity;
  std::vector<ErrorColumn> columns;
  for (std::size_t t = 0; t < rungs.front().trials.size(); ++t) {
    const std::string& data = rungs.front().trials[t].data;
    const auto add = [&](const char* what, const std::string& motor, Quantity quantity, std::size_t item) {
      columns.push_back({fmt::format("[{}] {}{}", t + 1, what, motor), data, quantity, t, item});
    };
    const auto loops = longest<LoopError>(
        rungs, t, [](const WholeTrial& e) -> const std::vector<LoopError>& { return e.loop.loops; });
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const std::string motor = loops.size() > 1 ? " " + loops[i].motor : "";
      add("position", motor, Quantity::closed_loop_position, i);
      add("force", motor, Quantity::closed_loop_force, i);
    }
    const auto motors = longest<NeededForce>(
        rungs, t, [](const WholeTrial& e) -> const std::vector<NeededForce>& { return e.inverse.motors; });
    for (std::size_t i = 0; i < motors.size(); ++i) {
      add("inverse", motors.size() > 1 ? " " + motors[i].motor : "", Quantity::inverse_force, i);
    }
  }
  return columns;
}

std::string score_text(bool has, double score) {
  return !has ? "-" : score < 1000.0 ? fmt::format("{:.3f}", score) : fmt::format("{:.0f}", score);
}

std::string percent_text(std::optional<double> percent) {
  return percent ? fmt::format("{:.3g}", *percent) : "-";
}

/// One row for each model that was published, where it has a value for one of the columns.
std::vector<std::vector<std::string>> published_rows(const std::vector<ReferenceValue>& published,
                                                     const std::vector<ErrorColumn>& columns) {
  std::vector<std::string> models;
  for (const ReferenceValue& value : published) {
    if (std::find(models.begin(), models.end(), value.model) == models.end()) {
      models.push_back(value.model);
    }
  }
  std::vector<std::vector<std::string>> rows;
  for (const std::string& model : models) {
    std::vector<std::string> row{"published: " + model, "-", "-"};
    bool any = false;
    for (const ErrorColumn& column : columns) {
      std::optional<double> percent;
      for (const ReferenceValue& value : published) {
        if (value.model == model && value.data == column.data && value.quantity == column.quantity) {
          percent = value.percent;
        }
      }
      any = any || percent.has_value();
      row.push_back(percent_text(percent));
    }
    if (any) {
      rows.push_back(row);
    }
  }
  return rows;
}

/// What is true of several trials or models is said once.
class Notes {
 public:
  void add(const std::string& what, const std::string& of) {
    auto note =
        std::find_if(notes_.begin(), notes_.end(), [&](const auto& one) { return one.first == what; });
    if (note == notes_.end()) {
      notes_.push_back({what, {}});
      note = notes_.end() - 1;
    }
    if (std::find(note->second.begin(), note->second.end(), of) == note->second.end()) {
      note->second.push_back(of);
    }
  }

  void print() const {
    for (const auto& [what, of] : notes_) {
      fmt::print("{}: {}\n", fmt::join(of, ", "), what);
    }
  }

 private:
  std::vector<std::pair<std::string, std::vector<std::string>>> notes_;
};

void print_notes(const std::vector<api::LadderRung>& rungs) {
  Notes notes;
  for (std::size_t m = 0; m < rungs.size(); ++m) {
    for (const WholeTrial& trial : rungs[m].trials) {
      if (!trial.inverse.not_available.empty()) {
        notes.add(fmt::format("no inverse model with ({}), {}.", m + 1, trial.inverse.not_available),
                  trial.trial);
      }
      if (!trial.loop.not_available.empty()) {
        notes.add(fmt::format("no closed loop, {}.", trial.loop.not_available), trial.trial);
      }
      for (const LoopError& error : trial.loop.loops) {
        if (error.disturbance_factor != 0.0 && std::abs(error.disturbance_factor - 1.0) > kWorthSaying) {
          notes.add(
              fmt::format("the recorded command of {} shows a disturbance {:.4f} times its column "
                          "(least squares on the controller's own equation); the column is used as it is.",
                          error.motor, error.disturbance_factor),
              trial.trial);
        }
      }
    }
  }
  notes.print();
}

void print(const std::vector<api::LadderRung>& rungs, const std::vector<ReferenceValue>& published) {
  const std::vector<ErrorColumn> columns = error_columns(rungs);
  std::vector<std::string> head{"model", "train", "held-out"};
  for (const ErrorColumn& column : columns) {
    head.push_back(column.head);
  }
  std::vector<std::vector<std::string>> rows;
  for (std::size_t m = 0; m < rungs.size(); ++m) {
    const api::LadderRung& rung = rungs[m];
    std::vector<std::string> row{fmt::format("({}) {}", m + 1, rung.name),
                                 score_text(rung.has_train, rung.windows.scores.train),
                                 score_text(rung.has_held_out, rung.windows.scores.held_out)};
    for (const ErrorColumn& column : columns) {
      row.push_back(percent_text(value_of(rung, column)));
    }
    rows.push_back(row);
  }
  for (const std::vector<std::string>& row : published_rows(published, columns)) {
    rows.push_back(row);
  }
  if (rungs.front().windows.scores.test > 0.0) {
    constexpr std::ptrdiff_t kBehindHeldOut = 3;
    head.insert(head.begin() + kBehindHeldOut, "test");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::string text = i < rungs.size() ? score_text(true, rungs[i].windows.scores.test) : "";
      rows[i].insert(rows[i].begin() + kBehindHeldOut, text);
    }
  }
  fmt::print("train, held-out: error in windows from their own start, in units of the floor.\n");
  if (!columns.empty()) {
    fmt::print(
        "position, force: the whole trial simulated with its controller; inverse: force that the measured "
        "motion needs; both in % of what was measured.\n");
    for (std::size_t t = 0; t < rungs.front().trials.size(); ++t) {
      const WholeTrial& trial = rungs.front().trials[t];
      fmt::print("[{}] {} ({})\n", t + 1, trial.trial, to_string(trial.role));
    }
  }
  fmt::print("\n");
  print_table(head, rows);
  print_errors(rungs);
  fmt::print("\n");
  print_notes(rungs);
  if (!published_rows(published, columns).empty()) {
    fmt::print("Published values: {} (and further entries of reference.yaml).\n", published.front().source);
  }
}

void run(const LadderInputs& inputs) {
  check_writable(inputs.inputs.json);
  api::Ladder ladder;
  {
    ProgressLine progress;
    ladder = api::ladder(inputs.inputs, inputs.models, &stop_flag(), progress.callback());
  }
  write_json(api::to_json(ladder), inputs.inputs.json);
  print(ladder.rungs, ladder.published);
}

}  // namespace

void add_ladder(CLI::App& app, Outcome& /*outcome*/) {
  auto ladder = std::make_shared<LadderInputs>();
  CLI::App* command = app.add_subcommand("ladder", "The models so far and how their errors fell");
  add_data_inputs(*command, ladder->inputs);
  command
      ->add_option("--model", ladder->models,
                   "model file; one: it and every model it stands on, several: these, in this order")
      ->type_name("FILE");
  command->footer(
      "Example:\n  plumbline ladder validation/trials/emps/identification validation/trials/emps/pulses "
      "--data emps --model found.yaml");
  command->callback([ladder] { run(*ladder); });
}

}  // namespace plumbline::cli
