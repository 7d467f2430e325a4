#include "validation/identify/trial/trial_points.h"

#include <algorithm>
#include <cmath>

#include "simulator/model/kinds.h"
#include "simulator/model/rotation_vector.h"
#include "simulator/trace/number_text.h"
#include "validation/identify/trial/trial_columns.h"

namespace plumbline::validation {

using model::Model;
using model::YamlNode;

const model::Sensor* point_sensor(const Model& model, const std::string& group) {
  const auto found = std::find_if(model.sensors.begin(), model.sensors.end(),
                                  [&](const model::Sensor& one) { return one.group == group; });
  return group.empty() || found == model.sensors.end() ? nullptr : &*found;
}

/// The three components of what is measured at a point of a link, from `columns` in one entry; of an
/// orientation the four of a quaternion.
void read_point(const YamlNode& node, const model::Sensor& first, const Model& model,
                std::vector<MeasuredUse>& uses) {
  const bool turns = first.reading == model::PointReading::orientation;
  const std::string owner = "sensor " + first.group;
  const std::string unit = turns ? "1" : model::reading_unit(model, first.name);
  if (!node.is_map()) {
    node.refuse("a map {columns: [...], unit: " + unit + "}");
  }
  std::vector<std::string> keys{"topic", "columns", "unit", "resolution", "noise"};
  if (!turns) {
    keys.emplace_back("offset_uncertainty");
  }
  node.allow_keys(keys);
  const std::vector<YamlNode> names = node.at("columns").items();
  const std::size_t wanted = turns ? 4 : 3;
  if (names.size() != wanted) {
    node.at("columns").refuse(std::to_string(names.size()) + " columns",
                              turns ? "four: w, x, y and z of the quaternion" : "three: x, y and z");
  }
  MeasuredUse use{turns ? first.group : "", {}};
  const std::string floor_unit = model::reading_unit(model, first.name);
  use.resolution = read_not_negative(node, "resolution", floor_unit, owner);
  use.noise = read_not_negative(node, "noise", floor_unit, owner);
  use.offset_uncertainty = read_not_negative(node, "offset_uncertainty", floor_unit, owner).value_or(0.0);
  for (std::size_t i = 0; i < wanted; ++i) {
    ColumnUse column = read_named_column(node, names[i], unit, owner);
    if (turns) {
      use.quaternion.push_back(std::move(column));
    } else {
      use.sensor = first.group + "_" + "xyz"[i];
      use.column = std::move(column);
      uses.push_back(use);
    }
  }
  if (turns) {
    uses.push_back(std::move(use));
  }
}

Eigen::Matrix3Xd rotation_vectors(const std::array<Eigen::VectorXd, 4>& quaternions, const std::string& file,
                                  const std::string& column) {
  constexpr double kShortest = 0.5;  // a recorder rounds; it does not halve
  constexpr double kPi = 3.14159265358979323846;
  const Eigen::Index rows = quaternions.front().size();
  Eigen::Matrix3Xd turns(3, rows);
  for (Eigen::Index k = 0; k < rows; ++k) {
    const Eigen::Quaterniond q(quaternions[0][k], quaternions[1][k], quaternions[2][k], quaternions[3][k]);
    if (!(q.norm() > kShortest)) {
      throw InputError(
          {file, 0, column},
          "a quaternion of length " + number_text(q.norm(), 3) + " in row " + std::to_string(k + 1),
          "length 1");
    }
    Eigen::Vector3d r = model::rotation_vector(q.normalized().toRotationMatrix());
    const double angle = r.norm();
    if (k > 0 && angle > 0.0) {
      const Eigen::Vector3d axis = r / angle;
      const double turns_more = std::round((axis.dot(turns.col(k - 1)) - angle) / (2.0 * kPi));
      r = (angle + 2.0 * kPi * turns_more) * axis;
    }
    turns.col(k) = r;
  }
  return turns;
}

}  // namespace plumbline::validation
