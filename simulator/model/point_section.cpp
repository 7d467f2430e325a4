// Sensors at points of links: markers, orientations, gyroscopes, accelerometers.
#include <algorithm>
#include <array>

#include "simulator/model/frames_in_file.h"
#include "simulator/model/kinds.h"
#include "simulator/model/model_sections.h"
#include "simulator/model/quantity.h"

namespace plumbline::model {
namespace {

struct Kind {
  const char* key;
  PointReading reading;
  const char* unit;
  bool has_point, has_axes;  ///< does it depend on them?
};

constexpr std::array<Kind, 4> kKinds{{{"marker", PointReading::marker, "m", true, false},
                                      {"orientation", PointReading::orientation, "rad", false, true},
                                      {"gyroscope", PointReading::gyroscope, "rad/s", false, true},
                                      {"accelerometer", PointReading::accelerometer, "m/s^2", true, true}}};

const Kind* kind_of(const YamlNode& entry) {
  const auto* found =
      std::find_if(kKinds.begin(), kKinds.end(), [&](const Kind& kind) { return entry.has(kind.key); });
  return found == kKinds.end() ? nullptr : found;
}

/// A link that some joint moves.
int moving_link(const YamlNode& node, const Model& model) {
  const std::vector<std::string> known = model.places(effects::Place::body);
  if (std::find(known.begin(), known.end(), node.text()) == known.end()) {
    node.refuse(quote(node.text()), "the name of a link of the skeleton" + nearest_names(node.text(), known));
  }
  const int link = model.body_index(node.text());
  for (int body = link; body >= 0;) {
    const Joint& joint = model.skeleton.joints[static_cast<std::size_t>(body)];
    if (joint.type != JointType::fixed) {
      return link;
    }
    body = joint.parent;
  }
  node.refuse(quote(node.text()) + ", which no joint moves", "a link that moves");
}

}  // namespace

bool is_point_sensor(const YamlNode& entry) { return entry.is_map() && kind_of(entry) != nullptr; }

void read_point_sensor(const std::string& name, const YamlNode& entry, Model& model) {
  check_name(name, entry);
  const Kind& kind = *kind_of(entry);
  std::vector<std::string> keys{kind.key, "resolution", "noise", "source", "assumed"};
  Sensor sensor;
  sensor.group = name;
  sensor.reading = kind.reading;
  if (kind.has_point) {
    keys.emplace_back("at");
  }
  if (kind.has_axes) {
    keys.emplace_back("turn");
  }
  entry.allow_keys(keys);
  sensor.body = moving_link(entry.at(kind.key), model);
  if (const auto at = kind.has_point ? entry.find("at") : std::nullopt) {
    at->allow_keys({"value", "unit"});
    sensor.point = factor_of(at->at("unit"), "m") * three(at->at("value"), "[x, y, z] in the link's frame");
  }
  if (const auto turn = kind.has_axes ? entry.find("turn") : std::nullopt) {
    sensor.mounting = turned(*turn);
  }
  // The sensor's own source stands for what states none.
  const auto read = [&](const char* key, double& value) {
    const auto given = entry.find(key);
    if (given && (given->has("source") || given->has("assumed"))) {
      value = read_quantity(*given, {kind.unit, QuantityRule::Sign::not_negative, false, {}}).value;
    } else if (given) {
      given->allow_keys({"value", "unit"});
      value = factor_of(given->at("unit"), kind.unit) * given->at("value").number();
      if (value < 0.0) {
        given->at("value").refuse(given->at("value").text(), "a number that is not negative");
      }
    }
  };
  read("resolution", sensor.resolution);
  read("noise", sensor.noise);
  if (sensor.floor() == 0.0) {
    entry.refuse("neither resolution nor noise above zero",
                 "one of them: together they are the floor of each component");
  }
  sensor.source = read_origin(entry).text;
  for (sensor.axis = 0; sensor.axis < 3; ++sensor.axis) {
    sensor.name = name + "_" + "xyz"[sensor.axis];
    model.sensors.push_back(sensor);
  }
}

}  // namespace plumbline::model
