#include "validation/identify/trial/trial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>

#include "simulator/trace/log_file.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/trial/computed_command.h"
#include "validation/identify/trial/sampling.h"
#include "validation/identify/trial/trial_data.h"
#include "validation/identify/trial/trial_file.h"
#include "validation/identify/trial/trial_points.h"

namespace plumbline::validation {
namespace {

namespace fs = std::filesystem;

std::string folder_name(const std::string& trial_file) {
  std::error_code none;
  return fs::weakly_canonical(trial_file, none).parent_path().filename().string();
}

/// Rows of the data file that lie in a stretch of the recording.
struct Rows {
  Eigen::Index first = 0, count = 0;
};

[[noreturn]] void refuse_section(const Section& section, const Eigen::VectorXd& time) {
  throw InputError(section.place, number_text(section.from) + " to " + number_text(section.to) + " s",
                   "a stretch of the recording, which lasts from " + number_text(time[0]) + " to " +
                       number_text(time[time.size() - 1]) + " s");
}

/// `beyond`: s that a section may end behind the last row. Even samples may end up to one step before the
/// last row of an uneven recording, and a section that ends with the recording is meant to.
Rows rows_of(const Section& section, const Eigen::VectorXd& time, double beyond = 0.0) {
  const double* begin = time.data();
  const double* end = begin + time.size();
  const double* from = std::lower_bound(begin, end, section.from);
  const double* to = std::lower_bound(begin, end, section.to);
  if (from == to || section.to > time[time.size() - 1] + beyond) {
    refuse_section(section, time);
  }
  return {from - begin, to - from};
}

/// 1 where a force is above the level at which the switch closes, else 0.
Eigen::VectorXd closed_above(const Eigen::VectorXd& force, double level) {
  return (force.array() > level).cast<double>();
}

Eigen::VectorXd without_zero(const Eigen::VectorXd& values, const Rows& empty) {
  return values.array() - values.segment(empty.first, empty.count).mean();
}

void check_switch(const Table& table, const ColumnUse& use, const Eigen::VectorXd& values) {
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    if (values[k] != 0.0 && values[k] != 1.0 && !std::isnan(values[k])) {
      throw InputError({table.file, 0, use.name}, number_text(values[k]) + " in row " + std::to_string(k + 1),
                       "0 (open) or 1 (closed): it is a contact switch");
    }
  }
}

/// Reads a data file's signals into a trial: rows first, where the controllers' laws are, then samples.
class TrialReader {
 public:
  TrialReader(const TrialFile& file, const model::Model& model, const LogFile& log, Trial& trial)
      : file_(file),
        model_(model),
        log_(log),
        trial_(trial),
        rows_(row_times(file, log)),
        grid_(rows_.time, file.sampling, {log.table.file, 0, file.time.name}),
        gaps_(grid_.gaps()) {}

  void read() {
    trial_.time = grid_.time();
    trial_.period = grid_.period();
    trial_.remarks = log_.remarks;
    trial_.remarks.insert(trial_.remarks.end(), rows_.remarks.begin(), rows_.remarks.end());
    if (!grid_.remark().empty()) {
      trial_.remarks.push_back(grid_.remark());
    }
    for (const MeasuredUse& use : file_.measured) {
      read_measured(use);
    }
    for (const CommandUse& use : file_.commands) {
      Signal signal = rows_of_column(use.column, true);
      trial_.commands.push_back(
          {use.motor, use.column.name, signal.unit, grid_.held_mean(signal.values), {}, use.before});
    }
    for (const ControllerUse& use : file_.controllers) {
      read_controller(use);
    }
    find_stretches();
  }

 private:
  bool is_used(double time) const {
    const auto has = [time](const Section& part) { return part.from <= time && time <= part.to; };
    const std::vector<Section>& in = file_.sections;
    return (in.empty() || std::any_of(in.begin(), in.end(), has)) &&
           std::none_of(file_.left_out.begin(), file_.left_out.end(), has);
  }

  /// What is in no section, or left out, may lack numbers without being asked.
  void refuse_missing(const std::string& column, const Eigen::VectorXd& values) const {
    for (Eigen::Index k = 0; k < values.size(); ++k) {
      if (!std::isfinite(values[k]) && is_used(rows_.time[k])) {
        throw InputError(
            {log_.table.file, 0, column},
            "an empty field in row " + std::to_string(rows_.rows[static_cast<std::size_t>(k)] + 1),
            "finite numbers; `missing: fill` in trial.yaml bridges missing ones");
      }
    }
  }

  /// The kept rows of a column, missing cells bridged.
  Signal rows_of_column(const ColumnUse& use, bool hold) {
    const bool is_in_part = !file_.sections.empty() || !file_.left_out.empty();
    Signal signal = read_signal(log_, use, file_.fill_missing || is_in_part);
    signal.values = kept(signal.values, rows_.rows);
    if (!file_.fill_missing) {
      refuse_missing(use.name, signal.values);
    }
    if (!grid_.fill(signal.values, hold, gaps_)) {
      throw InputError({log_.table.file, 0, use.name}, "no number in the whole column", "numbers");
    }
    return signal;
  }

  /// As rotation vectors that go on past half a turn, so that they can be interpolated.
  void read_orientation(const MeasuredUse& use) {
    std::array<Eigen::VectorXd, 4> parts;
    std::string columns;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i] = rows_of_column(use.quaternion[i], false).values;
      columns += (i > 0 ? " " : "") + use.quaternion[i].name;
    }
    const Eigen::Matrix3Xd turns = rotation_vectors(parts, log_.table.file, use.quaternion.front().name);
    for (int axis = 0; axis < 3; ++axis) {
      trial_.measured.push_back({use.sensor + "_" + "xyz"[axis], columns, "1",
                                 grid_.interpolated(turns.row(axis).transpose()), use.resolution, use.noise,
                                 0.0});
    }
  }

  void read_measured(const MeasuredUse& use) {
    if (!use.quaternion.empty()) {
      read_orientation(use);
      return;
    }
    const bool is_switch = model_.find_switch(use.sensor) != nullptr;
    Signal signal = rows_of_column(use.column, is_switch);
    if (is_switch) {
      if (use.above) {
        signal.values = closed_above(signal.values, *use.above);
      } else {
        check_switch(log_.table, use.column, signal.values);
      }
      trial_.switches.push_back(
          record_of(*model_.find_switch(use.sensor), use.column.name, grid_.held(signal.values)));
      return;
    }
    if (use.zero) {
      signal.values = without_zero(signal.values, rows_of(*use.zero, rows_.time));
    }
    measured_rows_.emplace(use.sensor, signal.values);
    trial_.measured.push_back({use.sensor, use.column.name, signal.unit, grid_.interpolated(signal.values),
                               use.resolution, use.noise, use.offset_uncertainty});
  }

  Eigen::VectorXd optional_rows(const std::optional<ColumnUse>& use) {
    return use ? rows_of_column(*use, true).values : Eigen::VectorXd();
  }

  /// A motor without a recorded command gets the one that the law gives; a cascade_pd is kept, too, so that
  /// the closed loop can be run.
  void read_controller(const ControllerUse& use) {
    Controller controller = use.controller;
    controller.reference = rows_of_column(use.reference, true).values;
    controller.disturbance = optional_rows(use.disturbance);
    const auto recorded = [&](const Command& command) { return command.motor == controller.motor; };
    if (std::none_of(trial_.commands.begin(), trial_.commands.end(), recorded)) {
      const Eigen::VectorXd command =
          computed_command(controller, {rows_.time, measured_rows_.at(controller.sensor),
                                        optional_rows(use.velocity), optional_rows(use.reference_velocity)});
      trial_.commands.push_back({controller.motor, "", model_.find_motor(controller.motor)->command_unit,
                                 grid_.held_mean(command), law_of_command(controller)});
      trial_.remarks.push_back("The command of " + controller.motor +
                               " was not recorded: " + law_of_command(controller) + ".");
    }
    if (controller.kind != "pd") {
      controller.reference = grid_.held(controller.reference);
      controller.disturbance =
          controller.disturbance.size() > 0 ? grid_.held(controller.disturbance) : Eigen::VectorXd();
      trial_.controllers.push_back(std::move(controller));
    }
  }

  /// Sections and what is left out of them are gaps like any other.
  void find_stretches() {
    const double end = trial_.time[trial_.samples() - 1] + 2.0 * trial_.period;
    double behind = trial_.time[0] - 2.0 * trial_.period;
    for (const Section& section : file_.sections) {
      rows_of(section, trial_.time, trial_.period);  // refuses one that is not there
      gaps_.push_back({behind, section.from});
      behind = section.to - 2.0 * grid_.hair();
    }
    if (!file_.sections.empty()) {
      gaps_.push_back({behind, end});
    }
    for (const Section& left : file_.left_out) {
      if (left.to < trial_.time[0] || left.from > trial_.time[trial_.samples() - 1]) {
        refuse_section(left, trial_.time);
      }
      gaps_.push_back({left.from - 2.0 * grid_.hair(), left.to + 2.0 * grid_.hair()});
    }
    if (gaps_.empty()) {
      return;
    }
    const std::vector<Stretch> stretches = grid_.stretches(gaps_);
    if (stretches.empty()) {
      throw InputError({trial_.file, 0, "data"},
                       "no sample that is in no gap and in no part that is left out",
                       "a stretch of the recording that can be used");
    }
    keep(stretches.front().first, stretches.back().end - stretches.front().first);
    if (stretches.size() > 1) {
      for (const Stretch& stretch : stretches) {
        trial_.stretches.push_back(
            {stretch.first - stretches.front().first, stretch.end - stretches.front().first});
      }
    }
  }

  static void keep(Eigen::Index first, Eigen::Index count, Eigen::VectorXd& values) {
    if (values.size() > 0) {
      values = Eigen::VectorXd(values.segment(first, count));
    }
  }

  void keep(Eigen::Index first, Eigen::Index count) {
    constexpr Eigen::Index kFewest = 20;
    if (count < kFewest) {
      throw InputError({trial_.file, 0, "section"}, std::to_string(count) + " samples",
                       "at least " + std::to_string(kFewest) + " samples");
    }
    trial_.first_row = first;
    for (Measured& channel : trial_.measured) {
      keep(first, count, channel.values);
    }
    for (SwitchRecord& record : trial_.switches) {
      keep(first, count, record.values);
    }
    for (Command& command : trial_.commands) {
      if (first > 0) {
        command.before.reset();  // it was said of the recording's first row
      }
      keep(first, count, command.values);
    }
    for (Controller& controller : trial_.controllers) {
      keep(first, count, controller.reference);
      keep(first, count, controller.disturbance);
    }
    keep(first, count, trial_.time);
  }

  const TrialFile& file_;
  const model::Model& model_;
  const LogFile& log_;
  Trial& trial_;
  RowTimes rows_;
  Grid grid_;
  std::vector<Gap> gaps_;
  std::map<std::string, Eigen::VectorXd> measured_rows_;
};

void check_events(const Trial& trial) {
  for (const double event : trial.events) {
    if (event < trial.time[0] || event > trial.time[trial.samples() - 1]) {
      throw InputError({trial.file, 0, "events"}, number_text(event) + " s", "times within the recording");
    }
  }
}

/// Columns that a file with many of them is asked for, and which of them hold until the next value.
LogQuestion question_of(TrialFile file, const model::Model& model) {
  LogQuestion question;
  question.names = file.columns;
  for_each_column(file, [&](const ColumnUse& use) {
    if (!use.name.empty()) {
      question.wanted.push_back(use.name);
      question.held.insert(use.name);
    }
  });
  for (const MeasuredUse& use : file.measured) {
    for (const ColumnUse& column : use.quaternion) {
      question.held.erase(column.name);
    }
    if (model.find_switch(use.sensor) == nullptr) {
      question.held.erase(use.column.name);
    }
  }
  return question;
}

void refuse_topic_of_no_bag(const TrialFile& file, const std::string& data) {
  if (file.topic_place && !is_bag(data)) {
    throw InputError(*file.topic_place, "a topic of " + data, "`topic` for a bag (.mcap, .db3) only");
  }
}

}  // namespace

Trial read_trial(const std::string& path, const model::Model& model, const TrialOptions& options) {
  const TrialFile file = read_trial_file(path, model);
  Trial trial;
  trial.file = file.path;
  trial.name = folder_name(file.path);
  trial.title = file.title;
  trial.model_file = file.model_file;
  trial.role = file.role;
  trial.locks = file.locks;
  trial.terrain = file.terrain;
  trial.configuration = file.configuration;
  trial.events = file.events;
  trial.data_file = data_path(file, options.data_folder);
  trial.start = file.start;
  trial.clock_shift_uncertainty = file.clock_shift_uncertainty;
  refuse_topic_of_no_bag(file, trial.data_file);
  const LogFile log = read_log(trial.data_file, question_of(file, model));
  if (is_bag(trial.data_file)) {
    trial.data_file = log.table.file;  // within a bag's folder
  }
  TrialReader(file, model, log, trial).read();
  trial.contact_events = contact_events(trial);
  check_events(trial);
  return trial;
}

std::string model_of_trial(const std::string& path) {
  const model::YamlNode root = model::YamlNode::load(trial_yaml(path));
  check_format(root, "trial/1");
  return read_model_path(root);
}

Eigen::MatrixXd command_samples(const model::Model& model, const std::vector<Command>& commands,
                                Eigen::Index samples) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model.motors.size()), samples);
  for (const Command& command : commands) {
    const int motor = model.motor_index(command.motor);
    if (motor >= 0) {
      all.row(motor) = command.values.transpose();
    }
  }
  return all;
}

Eigen::VectorXd commands_before(const model::Model& model, const std::vector<Command>& commands) {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.motors.size()));
  for (const Command& command : commands) {
    const int motor = model.motor_index(command.motor);
    if (motor >= 0 && command.values.size() > 0) {
      all[motor] = command.before.value_or(command.values[0]);
    }
  }
  return all;
}

}  // namespace plumbline::validation
