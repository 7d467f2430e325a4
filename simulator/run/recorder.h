// Every sample of a run, a row each: what was true, and what the robot's electronics knew.
#pragma once

#include <vector>

#include "simulator/run/sensors.h"
#include "simulator/run/simulation.h"
#include "simulator/run/wired_controller.h"
#include "simulator/trace/table.h"

namespace plumbline::run {

/// A table that grows row by row.
class Rows {
 public:
  void add_column(const std::string& name, const std::string& unit) { columns_.push_back({name, unit, {}}); }
  void add(double value) { values_.push_back(value); }
  void add(const Eigen::VectorXd& values) {
    values_.insert(values_.end(), values.data(), values.data() + values.size());
  }
  std::size_t columns() const { return columns_.size(); }
  Table table() const;

 private:
  std::vector<Column> columns_;
  std::vector<double> values_;
};

/// Trace: t; q_SENSOR, true positions without counts and noise; u_MOTOR, commands; F_FOOT_x, _y, _z, force of
/// the ground on the foot; F_CONTACT_x, _y, _z, that on the first of two links in contact; what the
/// controller logs, under its own names. SI. Record: t; the readings of the sensors under the same names;
/// u_MOTOR; s_SWITCH, 1 closed. SI.
class Recorder {
 public:
  Recorder(const model::Model& model, const WiredController* controller);

  void row(const Simulation& simulation, const Sensed& sensed, const Eigen::VectorXd& command);
  Table trace() const { return trace_.table(); }
  Table record() const { return record_.table(); }

 private:
  const WiredController* controller_;
  Rows trace_, record_;
};

}  // namespace plumbline::run
