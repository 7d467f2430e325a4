#include "simulator/run/recorder.h"

#include "simulator/model/kinds.h"

namespace plumbline::run {

Table Rows::table() const {
  Table table;
  table.columns = columns_;
  const auto width = static_cast<Eigen::Index>(columns_.size());
  const auto rows = width == 0 ? 0 : static_cast<Eigen::Index>(values_.size()) / width;
  const Eigen::Map<const Eigen::MatrixXd> all(values_.data(), width, rows);
  for (Eigen::Index c = 0; c < width; ++c) {
    table.columns[static_cast<std::size_t>(c)].values = all.row(c).transpose();
  }
  return table;
}

Recorder::Recorder(const model::Model& model, const WiredController* controller) : controller_(controller) {
  for (Rows* rows : {&trace_, &record_}) {
    rows->add_column("t", "s");
    for (const model::Sensor& sensor : model.sensors) {
      rows->add_column(model::reading_column(sensor), model::reading_unit(model, sensor.name));
    }
    for (const model::Motor& motor : model.motors) {
      rows->add_column("u_" + motor.name, motor.command_unit);
    }
  }
  for (const model::Foot& foot : model.feet) {
    for (const char* axis : {"x", "y", "z"}) {
      trace_.add_column("F_" + foot.name + "_" + axis, "N");
    }
  }
  for (const model::LinkContact& contact : model.contacts) {
    for (const char* axis : {"x", "y", "z"}) {
      trace_.add_column("F_" + contact.name + "_" + axis, "N");
    }
  }
  if (controller != nullptr) {
    for (const plumbline_port& port : controller->library().log()) {
      trace_.add_column(port.name, port.unit);
    }
  }
  for (const model::ContactSwitch& one : model.switches) {
    record_.add_column("s_" + one.name, "1");
  }
}

void Recorder::row(const Simulation& simulation, const Sensed& sensed, const Eigen::VectorXd& command) {
  trace_.add(simulation.time());
  trace_.add(simulation.outputs());
  trace_.add(command);
  for (const model::Touch& touch : simulation.touches()) {
    trace_.add(touch.force);
  }
  for (const Eigen::Vector3d& force : simulation.contact_forces()) {
    trace_.add(force);
  }
  if (controller_ != nullptr) {
    for (const double value : controller_->log()) {
      trace_.add(value);
    }
  }
  record_.add(simulation.time());
  record_.add(sensed.readings);
  record_.add(command);
  record_.add(sensed.switches);
}

}  // namespace plumbline::run
