#include "simulator/model/frames_in_file.h"

#include "simulator/model/rotation_vector.h"
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
  return roll_pitch_yaw(factor_of(turn.at("unit"), "rad") * three(turn.at("value"), "roll, pitch and yaw"));
}

}  // namespace plumbline::model
