#include "validation/api/trial_arrays.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/trial/physical_number.h"
#include "validation/identify/trial/sampling.h"
#include "validation/identify/trial/trial_data.h"

namespace plumbline::api {
namespace {

using model::Model;
using validation::Grid;
using validation::Signal;
using validation::Trial;

/// One channel as a data file with a single column would be read.
Signal read_channel(const TrialArrays& arrays, const Channel& channel, const std::string& expected_unit,
                    const std::string& owner) {
  const Place_in_file where{arrays.name, 0, channel.name};
  if (channel.values.size() != arrays.time.size()) {
    throw InputError(where, std::to_string(channel.values.size()) + " values",
                     std::to_string(arrays.time.size()) + ", as many as there are times");
  }
  for (Eigen::Index k = 0; k < channel.values.size(); ++k) {
    if (!std::isfinite(channel.values[k])) {
      throw InputError(where, "no finite number at index " + std::to_string(k), "finite numbers");
    }
  }
  LogFile log;
  log.table.file = arrays.name;
  log.table.columns.push_back({channel.name, "", channel.values});
  validation::ColumnUse use;
  use.name = channel.name;
  use.unit = channel.unit;
  use.expected_unit = expected_unit;
  use.owner = owner;
  use.place = where;
  return validation::read_signal(log, use, false);
}

void refuse_twice(const TrialArrays& arrays, const std::vector<Channel>& channels) {
  std::set<std::string> seen;
  for (const Channel& channel : channels) {
    if (!seen.insert(channel.name).second) {
      throw InputError({arrays.name, 0, channel.name}, "two channels", "one channel of each name");
    }
  }
}

std::vector<std::string> known_sensors(const Model& model) {
  std::vector<std::string> names;
  for (const model::Sensor& sensor : model.sensors) {
    names.push_back(sensor.name);
  }
  for (const model::ContactSwitch& one : model.switches) {
    names.push_back(one.name);
  }
  return names;
}

void add_switch(const TrialArrays& arrays, const Model& model, const Grid& grid, const Channel& channel,
                Trial& trial) {
  Signal signal = read_channel(arrays, channel, "1", "contact switch " + channel.name);
  for (Eigen::Index k = 0; k < signal.values.size(); ++k) {
    if (signal.values[k] != 0.0 && signal.values[k] != 1.0) {
      throw InputError({arrays.name, 0, channel.name},
                       number_text(signal.values[k]) + " at index " + std::to_string(k),
                       "0 (open) or 1 (closed): it is a contact switch");
    }
  }
  trial.switches.push_back(
      validation::record_of(*model.find_switch(channel.name), "q_" + channel.name, grid.held(signal.values)));
}

void add_measured(const TrialArrays& arrays, const Model& model, const Grid& grid, Trial& trial) {
  refuse_twice(arrays, arrays.measured);
  for (const Channel& channel : arrays.measured) {
    if (model.find_switch(channel.name) != nullptr) {
      add_switch(arrays, model, grid, channel, trial);
      continue;
    }
    if (model.find_sensor(channel.name) == nullptr) {
      throw InputError({arrays.name, 0, "measured"}, "\"" + channel.name + "\"",
                       "a sensor of the model" + nearest_names(channel.name, known_sensors(model)));
    }
    Signal signal =
        read_channel(arrays, channel, model::reading_unit(model, channel.name), "sensor " + channel.name);
    trial.measured.push_back(
        {channel.name, "q_" + channel.name, signal.unit, grid.interpolated(signal.values)});
  }
  if (trial.measured.empty()) {
    throw InputError({arrays.name, 0, "measured"}, "no sensor", "at least one sensor of the model");
  }
}

std::vector<std::string> known_motors(const Model& model) {
  std::vector<std::string> names;
  for (const model::Motor& motor : model.motors) {
    names.push_back(motor.name);
  }
  return names;
}

void add_commands(const TrialArrays& arrays, const Model& model, const Grid& grid, Trial& trial) {
  refuse_twice(arrays, arrays.commands);
  for (const Channel& channel : arrays.commands) {
    const model::Motor* motor = model.find_motor(channel.name);
    if (motor == nullptr) {
      throw InputError({arrays.name, 0, "commands"}, "\"" + channel.name + "\"",
                       "a motor of the model" + nearest_names(channel.name, known_motors(model)));
    }
    Signal signal = read_channel(arrays, channel, motor->command_unit, "motor " + channel.name);
    trial.commands.push_back({channel.name, "u_" + channel.name, signal.unit, grid.held_mean(signal.values)});
  }
}

void add_locks(const TrialArrays& arrays, const Model& model, Trial& trial) {
  for (const Held& held : arrays.locked) {
    const Place_in_file where{arrays.name, 0, "locked"};
    std::vector<std::string> names = known_motors(model);
    for (const model::Coordinate& coordinate : model.coordinates) {
      names.push_back(coordinate.name);
    }
    if (std::find(names.begin(), names.end(), held.name) == names.end()) {
      throw InputError(where, "\"" + held.name + "\"",
                       "a coordinate or motor" + nearest_names(held.name, names));
    }
    const std::string unit = model::position_unit(model::is_angular(model, held.name));
    trial.locks.push_back(
        {held.name, held.value * validation::unit_factor(held.unit, unit, held.name, where)});
  }
}

void add_events(const TrialArrays& arrays, Trial& trial) {
  for (const double event : arrays.events) {
    if (!(event >= trial.time[0] && event <= trial.time[trial.samples() - 1])) {
      throw InputError({arrays.name, 0, "events"}, number_text(event) + " s", "times within the recording");
    }
  }
  trial.events = arrays.events;
  std::sort(trial.events.begin(), trial.events.end());
}

Eigen::VectorXd rising_times(const TrialArrays& arrays) {
  const Eigen::VectorXd time = read_channel(arrays, {"time", "s", arrays.time}, "s", "time").values;
  for (Eigen::Index k = 1; k < time.size(); ++k) {
    if (!(time[k] > time[k - 1])) {
      throw InputError({arrays.name, 0, "time"}, number_text(time[k]) + " s at index " + std::to_string(k),
                       "a time above " + number_text(time[k - 1]) + " s, that of the index before");
    }
  }
  return time;
}

}  // namespace

Trial trial_from(const TrialArrays& arrays, const Model& model) {
  Trial trial;
  trial.file = trial.name = arrays.name;
  trial.title = arrays.title.empty() ? arrays.name : arrays.title;
  trial.model_file = model.file;
  trial.role = arrays.role;
  const Grid grid(rising_times(arrays), {}, {arrays.name, 0, "time"});
  trial.time = grid.time();
  trial.period = grid.period();
  if (!grid.remark().empty()) {
    trial.remarks.push_back(grid.remark());
  }
  if (!grid.gaps().empty()) {
    trial.stretches = grid.stretches(grid.gaps());
  }
  add_measured(arrays, model, grid, trial);
  add_commands(arrays, model, grid, trial);
  add_locks(arrays, model, trial);
  add_events(arrays, trial);
  trial.contact_events = validation::contact_events(trial);
  return trial;
}

}  // namespace plumbline::api
