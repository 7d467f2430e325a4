#include "simulator/model/kinds.h"

#include <algorithm>
#include <cctype>

namespace plumbline::model {

std::string reading_unit(const Model& model, const std::string& sensor) {
  const Sensor* known = model.find_sensor(sensor);
  if (known != nullptr && known->is_force_plate()) {
    return force_unit(false);
  }
  if (known != nullptr && known->is_at_point()) {
    switch (known->reading) {
      case PointReading::orientation:
        return "rad";
      case PointReading::gyroscope:
        return "rad/s";
      case PointReading::accelerometer:
        return "m/s^2";
      default:
        return "m";
    }
  }
  const std::string position = position_unit(model.place_is_angular(effects::Place::sensor, sensor));
  return known != nullptr && known->rate ? position + "/s" : position;
}

std::string reading_column(const Sensor& sensor) {
  if (sensor.is_at_point()) {
    return sensor.name;
  }
  return (sensor.is_force_plate() ? "F_" : sensor.rate ? "v_" : "q_") + sensor.name;
}

std::string ratio_unit(bool motor_angular, bool coordinate_angular) {
  if (motor_angular == coordinate_angular) {
    return "1";
  }
  return motor_angular ? "rad/m" : "m/rad";
}

std::string to_string(Loop::Type type) {
  switch (type) {
    case Loop::Type::connect:
      return "connect";
    case Loop::Type::hinge:
      return "hinge";
    case Loop::Type::weld:
      return "weld";
    case Loop::Type::rod:
      break;
  }
  return "rod";
}

std::string to_string(PointReading reading) {
  switch (reading) {
    case PointReading::marker:
      return "marker";
    case PointReading::orientation:
      return "orientation";
    case PointReading::gyroscope:
      return "gyroscope";
    case PointReading::accelerometer:
      return "accelerometer";
    case PointReading::none:
      break;
  }
  return "";
}

std::string measured_by(const Model& model, const Sensor& sensor) {
  if (sensor.is_at_point()) {
    return to_string(sensor.reading) + " on " +
           model.skeleton.bodies[static_cast<std::size_t>(sensor.body)].name;
  }
  std::string feet;
  for (const int foot : sensor.feet) {
    feet += (feet.empty() ? "vertical force on " : ", ") + model.feet[static_cast<std::size_t>(foot)].name;
  }
  return sensor.is_force_plate() ? feet : sensor.measures;
}

std::vector<std::string> joint_names(const Skeleton& skeleton) {
  std::vector<std::string> names;
  for (const Joint& joint : skeleton.joints) {
    if (joint.type != JointType::fixed) {
      names.push_back(joint.name);
    }
  }
  return names;
}

std::vector<std::string> coordinate_names(const Model& model) {
  return model.places(effects::Place::coordinate);
}

std::vector<std::string> motor_names(const Model& model) { return model.places(effects::Place::motor); }

std::vector<std::string> pulley_names(const Model& model) {
  std::vector<std::string> names;
  for (const Pulley& pulley : model.pulleys) {
    names.push_back(pulley.name);
  }
  return names;
}

std::vector<std::string> position_names(const Model& model) {
  std::vector<std::string> names = motor_names(model);
  const std::vector<std::string> coordinates = coordinate_names(model);
  names.insert(names.end(), coordinates.begin(), coordinates.end());
  return names;
}

const Joint* find_joint(const Skeleton& skeleton, const std::string& name) {
  const auto found = std::find_if(skeleton.joints.begin(), skeleton.joints.end(), [&](const Joint& joint) {
    return joint.name == name && joint.type != JointType::fixed;
  });
  return found == skeleton.joints.end() ? nullptr : &*found;
}

bool is_angular(const Model& model, const std::string& name) {
  if (const Motor* motor = model.find_motor(name)) {
    return motor->angular;
  }
  if (const Coordinate* coordinate = model.find_coordinate(name)) {
    return coordinate->angular;
  }
  const Joint* joint = find_joint(model.skeleton, name);
  return joint == nullptr || joint->type == JointType::revolute;
}

void check_name(const std::string& name, const YamlNode& node) {
  const auto legal = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.' || c == '-'; };
  if (!std::all_of(name.begin(), name.end(), legal) ||
      std::isdigit(static_cast<unsigned char>(name[0])) != 0) {
    node.refuse("name " + quote(name), "a name of letters, digits, _ . and - that begins with no digit");
  }
}

}  // namespace plumbline::model
