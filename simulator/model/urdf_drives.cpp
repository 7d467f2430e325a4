#include "simulator/model/urdf_drives.h"

#include <tinyxml2.h>

#include "simulator/trace/file_text.h"

namespace plumbline::model {

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
