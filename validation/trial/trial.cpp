#include "validation/trial/trial.h"

#include <algorithm>
#include <filesystem>

#include "simulator/trace/number_text.h"
#include "validation/trial/trial_data.h"
#include "validation/trial/trial_file.h"

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

Rows rows_of(const Section& section, const Eigen::VectorXd& time) {
  const double* begin = time.data();
  const double* end = begin + time.size();
  const double* from = std::lower_bound(begin, end, section.from);
  const double* to = std::lower_bound(begin, end, section.to);
  if (from == to || section.to > time[time.size() - 1]) {
    throw InputError(section.place, number_text(section.from) + " to " + number_text(section.to) + " s",
                     "a stretch of the recording, which lasts from " + number_text(time[0]) + " to " +
                         number_text(time[time.size() - 1]) + " s");
  }
  return {from - begin, to - from};
}

Eigen::VectorXd times_of(const TrialFile& file, const Table& table) {
  if (file.rate == 0.0) {
    return read_signal(table, file.time).values;
  }
  return Eigen::VectorXd::LinSpaced(table.rows(), 0.0, static_cast<double>(table.rows() - 1)) / file.rate;
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
    if (values[k] != 0.0 && values[k] != 1.0) {
      throw InputError({table.file, 0, use.name}, number_text(values[k]) + " in row " + std::to_string(k + 1),
                       "0 (open) or 1 (closed): it is a contact switch");
    }
  }
}

void read_signals(const TrialFile& file, const model::Model& model, const Table& table, Trial& trial) {
  for (const MeasuredUse& use : file.measured) {
    Signal signal = read_signal(table, use.column);
    if (use.above) {
      trial.switches.push_back(record_of(*model.find_switch(use.sensor), use.column.name,
                                         closed_above(signal.values, *use.above)));
      continue;
    }
    if (model.find_switch(use.sensor) != nullptr) {
      check_switch(table, use.column, signal.values);
      trial.switches.push_back(
          record_of(*model.find_switch(use.sensor), use.column.name, std::move(signal.values)));
      continue;
    }
    if (use.zero) {
      signal.values = without_zero(signal.values, rows_of(*use.zero, trial.time));
    }
    trial.measured.push_back({use.sensor, use.column.name, signal.unit, std::move(signal.values),
                              use.resolution, use.noise, use.offset_uncertainty});
  }
  for (const CommandUse& use : file.commands) {
    Signal signal = read_signal(table, use.column);
    trial.commands.push_back({use.motor, use.column.name, signal.unit, std::move(signal.values)});
  }
  for (const ControllerUse& use : file.controllers) {
    trial.controllers.push_back(use.controller);
    trial.controllers.back().reference = read_signal(table, use.reference).values;
    if (use.disturbance) {
      trial.controllers.back().disturbance = read_signal(table, *use.disturbance).values;
    }
  }
}

void keep(const Rows& rows, Eigen::VectorXd& values) {
  if (values.size() > 0) {
    values = Eigen::VectorXd(values.segment(rows.first, rows.count));
  }
}

void keep_section(const Section& section, Trial& trial) {
  const Rows rows = rows_of(section, trial.time);
  trial.first_row = rows.first;
  for (Measured& channel : trial.measured) {
    keep(rows, channel.values);
  }
  for (SwitchRecord& record : trial.switches) {
    keep(rows, record.values);
  }
  for (Command& command : trial.commands) {
    keep(rows, command.values);
  }
  for (Controller& controller : trial.controllers) {
    keep(rows, controller.reference);
    keep(rows, controller.disturbance);
  }
  keep(rows, trial.time);
}

void check_events(const Trial& trial) {
  for (const double event : trial.events) {
    if (event < trial.time[0] || event > trial.time[trial.samples() - 1]) {
      throw InputError({trial.file, 0, "events"}, number_text(event) + " s", "times within the recording");
    }
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
  trial.events = file.events;
  trial.data_file = data_path(file, options.data_folder);
  trial.start = file.start;
  const Table table =
      file.columns.empty() ? read_table(trial.data_file) : read_headerless_csv(trial.data_file, file.columns);
  trial.time = times_of(file, table);
  trial.period = checked_period(trial.time, table, file.time.name);
  read_signals(file, model, table, trial);
  if (file.section) {
    keep_section(*file.section, trial);
    trial.period = checked_period(trial.time, table, file.time.name);
  }
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

}  // namespace plumbline::validation
