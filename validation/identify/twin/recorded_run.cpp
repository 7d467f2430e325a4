#include "validation/identify/twin/recorded_run.h"

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

const Eigen::VectorXd& values_of(const Table& record, const std::string& name) {
  const Column* column = record.find(name);
  if (column == nullptr) {
    throw InputError("the record has no column " + name);
  }
  return column->values;
}

}  // namespace

Trial recorded_run(const model::Model& model, const Table& record, const run::Scenario& scenario) {
  Trial trial;
  trial.title = scenario.title;
  trial.terrain = scenario.terrain;
  trial.model_file = model.file;
  trial.time = values_of(record, "t");
  if (trial.samples() < 2) {
    throw InputError("the run ended before its second sample: there is nothing to record");
  }
  trial.period = (trial.time[trial.samples() - 1] - trial.time[0]) / static_cast<double>(trial.samples() - 1);
  for (const model::Motor& motor : model.motors) {
    Command command;
    command.motor = motor.name;
    command.values = values_of(record, "u_" + motor.name);
    trial.commands.push_back(std::move(command));
  }
  for (const model::Sensor& sensor : model.sensors) {
    Measured channel;
    channel.sensor = sensor.name;
    channel.values = values_of(record, model::reading_column(sensor));
    trial.measured.push_back(std::move(channel));
  }
  for (const model::ContactSwitch& one : model.switches) {
    trial.switches.push_back({one.name, "", values_of(record, "s_" + one.name)});
  }
  trial.contact_events = contact_events(trial);
  return trial;
}

}  // namespace plumbline::validation
