#include "validation/hopping/hop_recorder.h"

#include "simulator/model/kinds.h"

namespace plumbline::validation {

HopRecorder::HopRecorder(const model::Model& model) {
  columns_.push_back({"t", "s", {}});
  for (const model::Sensor& sensor : model.sensors) {
    columns_.push_back({model::reading_column(sensor), model::reading_unit(model, sensor.name), {}});
  }
  for (const model::Motor& motor : model.motors) {
    columns_.push_back({"u_" + motor.name, motor.command_unit, {}});
  }
  for (const model::Foot& foot : model.feet) {
    for (const char* axis : {"x", "y", "z"}) {
      columns_.push_back({"F_" + foot.name + "_" + axis, "N", {}});
    }
  }
  columns_.push_back({"phase", "1", {}});
  columns_.push_back({"torso_wanted", "rad", {}});
}

void HopRecorder::row(double t, const Eigen::VectorXd& outputs, const Eigen::VectorXd& command,
                      const std::vector<model::Touch>& touches, const controllers::Hopping& controller) {
  values_.push_back(t);
  values_.insert(values_.end(), outputs.data(), outputs.data() + outputs.size());
  values_.insert(values_.end(), command.data(), command.data() + command.size());
  for (const model::Touch& touch : touches) {
    values_.insert(values_.end(), touch.force.data(), touch.force.data() + 3);
  }
  values_.push_back(static_cast<double>(controller.phase()));
  values_.push_back(controller.h_T_d());
}

Table HopRecorder::table() const {
  Table table;
  table.columns = columns_;
  const auto width = static_cast<Eigen::Index>(columns_.size());
  const auto rows = static_cast<Eigen::Index>(values_.size()) / width;
  const Eigen::Map<const Eigen::MatrixXd> all(values_.data(), width, rows);
  for (Eigen::Index c = 0; c < width; ++c) {
    table.columns[static_cast<std::size_t>(c)].values = all.row(c).transpose();
  }
  return table;
}

}  // namespace plumbline::validation
