#include "simulator/model/stated_drives.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/model/mjcf_values.h"
#include "simulator/trace/file_text.h"

namespace plumbline::model {
namespace {

using tinyxml2::XMLElement;

class DrivesReader : private MjcfValues {
 public:
  explicit DrivesReader(const MjcfDocument& document) : MjcfValues(document) {}

  MjcfDrives read() {
    each("worldbody", [&](const XMLElement& one) { collect_joint(one); });
    each("actuator", [&](const XMLElement& one) { read_actuator(one); });
    each("sensor", [&](const XMLElement& one) { read_sensor(one); });
    return std::move(drives_);
  }

 private:
  template <typename Work>
  void each(const char* name, const Work& work) const {
    for (const XMLElement* section : source_.sections(name)) {
      for (const XMLElement* one = section->FirstChildElement(); one != nullptr;
           one = one->NextSiblingElement()) {
        work(*one);
      }
    }
  }

  void collect_joint(const XMLElement& element) {
    if (std::string(element.Name()) == "joint" && element.Attribute("name") != nullptr) {
      joints_.insert(element.Attribute("name"));
    }
    for (const XMLElement* child = element.FirstChildElement(); child != nullptr;
         child = child->NextSiblingElement()) {
      collect_joint(*child);
    }
  }

  /// The joint that the element names; empty where it names none.
  std::string joint_of(const XMLElement& element) const {
    const char* joint = defaults_.attribute(element, "joint", "");
    if (joint == nullptr) {
      return "";
    }
    if (joints_.count(joint) == 0) {
      refuse(element, "joint \"" + std::string(joint) + "\"", "the name of a joint of the file");
    }
    return joint;
  }

  /// An attribute of several numbers; those that are not given are 0.
  std::vector<double> row(const XMLElement& element, const char* name, std::size_t least) const {
    const char* text = defaults_.attribute(element, name, "");
    std::vector<double> values;
    if (text != nullptr) {
      values = numbers(element, text, name);
    }
    values.resize(std::max(least, values.size()));
    return values;
  }

  double largest(const XMLElement& element, const char* range) const {
    const std::vector<double> ends = row(element, range, 2);
    return std::max(std::abs(ends[0]), std::abs(ends[1]));
  }

  void read_actuator(const XMLElement& element) {
    MjcfActuator one;
    one.joint = joint_of(element);
    if (one.joint.empty()) {
      return;
    }
    const char* name = element.Attribute("name");
    one.name = name != nullptr ? name : "";
    one.kind = element.Name();
    const bool has_gear = defaults_.attribute(element, "gear", "") != nullptr;
    const double gear = has_gear ? row(element, "gear", 1).front() : 1.0;
    one.limit = std::abs(gear) * largest(element, "forcerange");
    if (one.limit == 0.0 && one.kind == "motor") {
      one.limit = std::abs(gear) * largest(element, "ctrlrange");
    }
    set_servo(element, gear, one);
    drives_.actuators.push_back(one);
  }

  void set_servo(const XMLElement& element, double gear, MjcfActuator& one) const {
    if (one.kind == "position") {
      one.stiffness = gear * number(element, "kp", "", 1.0);
      one.damping = gear * number(element, "kv", "", 0.0);
    } else if (one.kind == "velocity") {
      one.damping = gear * number(element, "kv", "", 1.0);
    } else if (one.kind == "general") {
      const char* type = defaults_.attribute(element, "biastype", "");
      const std::vector<double> bias = row(element, "biasprm", 3);
      if (type != nullptr && std::string(type) == "affine") {
        one.stiffness = -gear * bias[1];
        one.damping = -gear * bias[2];
      }
    }
  }

  void read_sensor(const XMLElement& element) {
    const double noise = not_negative(element, "noise", "");
    if (std::string(element.Name()) == "jointpos" && noise > 0.0) {
      drives_.position_noise[joint_of(element)] = noise;
    }
  }

  std::set<std::string> joints_;
  MjcfDrives drives_;
};

}  // namespace

MjcfDrives read_mjcf_drives(const std::string& path) {
  const MjcfDocument document(path);
  return DrivesReader(document).read();
}

std::set<std::string> urdf_driven_joints(const std::string& path) {
  std::set<std::string> driven;
  tinyxml2::XMLDocument document;
  const std::string text = read_text(path);
  document.Parse(text.data(), text.size());
  const tinyxml2::XMLElement* robot = document.FirstChildElement("robot");
  if (robot == nullptr) {
    return driven;
  }
  const auto take = [&](const char* name) {
    if (name != nullptr) {
      driven.insert(name);
    }
  };
  for (const auto* one = robot->FirstChildElement("transmission"); one != nullptr;
       one = one->NextSiblingElement("transmission")) {
    take(one->Attribute("joint"));
    for (const auto* joint = one->FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      take(joint->Attribute("name"));
    }
  }
  return driven;
}

}  // namespace plumbline::model
