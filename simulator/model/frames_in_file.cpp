#include "simulator/model/frames_in_file.h"

#include <Eigen/Geometry>

#include "simulator/trace/units.h"

namespace plumbline::model {

using Eigen::Vector3d;

Vector3d three(const YamlNode& node, const std::string& expected) {
  const std::vector<YamlNode> numbers = node.items();
  if (numbers.size() != 3) {
    node.refuse(std::to_string(numbers.size()) + " numbers", "three: " + expected);
  }
  return {numbers[0].number(), numbers[1].number(), numbers[2].number()};
}

double factor_of(const YamlNode& unit, const char* like) {
  if (!units_agree(unit.text(), like)) {
    unit.refuse("unit " + quote(unit.text()), "a unit like " + quote(like));
  }
  return to_si_factor(unit.text());
}

Eigen::Matrix3d turned(const YamlNode& turn) {
  turn.allow_keys({"value", "unit"});
  const Vector3d angles = factor_of(turn.at("unit"), "rad") * three(turn.at("value"), "roll, pitch and yaw");
  return (Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) * Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()))
      .toRotationMatrix();
}

}  // namespace plumbline::model
