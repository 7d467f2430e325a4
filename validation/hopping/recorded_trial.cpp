#include "validation/hopping/recorded_trial.h"

#include <random>

#include "simulator/trace/error.h"
#include "validation/twin/twin.h"

namespace plumbline::validation {
namespace {

const Eigen::VectorXd& values_of(const Table& trace, const std::string& name) {
  const Column* column = trace.find(name);
  if (column == nullptr) {
    throw InputError("the trace has no column " + name);
  }
  return column->values;
}

}  // namespace

Trial recorded_trial(const model::Model& model, const Table& trace, std::uint64_t seed) {
  Trial trial;
  trial.title = model.robot + ", hopping";
  trial.model_file = model.file;
  trial.time = values_of(trace, "t");
  if (trial.samples() < 2) {
    throw InputError("the run ended before its second sample: there is nothing to record");
  }
  trial.period = (trial.time[trial.samples() - 1] - trial.time[0]) / static_cast<double>(trial.samples() - 1);
  for (const model::Motor& motor : model.motors) {
    Command command;
    command.motor = motor.name;
    command.values = values_of(trace, "u_" + motor.name);
    trial.commands.push_back(std::move(command));
  }
  std::mt19937_64 random(seed);
  for (const model::Sensor& sensor : model.sensors) {
    Measured channel;
    channel.sensor = sensor.name;
    channel.values = values_of(trace, "q_" + sensor.name);
    for (double& value : channel.values) {
      value = sensor_reading(sensor, value, random);
    }
    trial.measured.push_back(std::move(channel));
  }
  for (const model::ContactSwitch& one : model.switches) {
    const Eigen::VectorXd& force =
        values_of(trace, "F_" + model.feet[static_cast<std::size_t>(one.foot)].name + "_z");
    trial.switches.push_back({one.name, "", (force.array() > 0.0).cast<double>().matrix()});
  }
  trial.contact_events = contact_events(trial);
  return trial;
}

}  // namespace plumbline::validation
