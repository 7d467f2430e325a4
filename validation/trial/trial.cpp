#include "validation/trial/trial.h"

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
    if (model.find_switch(use.sensor) != nullptr) {
      check_switch(table, use.column, signal.values);
      trial.switches.push_back({use.sensor, use.column.name, std::move(signal.values)});
      continue;
    }
    trial.measured.push_back({use.sensor, use.column.name, signal.unit, std::move(signal.values)});
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
  const Table table = read_table(trial.data_file);
  trial.time = read_signal(table, file.time).values;
  trial.period = checked_period(trial.time, table, file.time.name);
  read_signals(file, model, table, trial);
  trial.contact_events = contact_events(trial);
  check_events(trial);
  return trial;
}

std::string model_of_trial(const std::string& path) {
  const model::YamlNode root = model::YamlNode::load(trial_yaml(path));
  check_version(root, "trial/1");
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
