#include "simulator/model/mjcf_defaults.h"

namespace plumbline::model {

using tinyxml2::XMLElement;

MjcfDefaults::MjcfDefaults(const MjcfDocument& document) {
  for (const XMLElement* top : document.sections("default")) {
    add(*top, "");
  }
}

void MjcfDefaults::add(const XMLElement& element, const std::string& parent) {
  const char* given = element.Attribute("class");
  const std::string name = given != nullptr ? given : "main";
  if (parent.empty()) {
    main_ = name;
  }
  Class& known = classes_[name];
  known.elements.push_back(&element);
  known.parent = parent;
  for (const XMLElement* child = element.FirstChildElement("default"); child != nullptr;
       child = child->NextSiblingElement("default")) {
    add(*child, name);
  }
}

const char* MjcfDefaults::attribute(const XMLElement& element, const char* name,
                                    const std::string& childclass) const {
  if (const char* own = element.Attribute(name)) {
    return own;
  }
  const char* given = element.Attribute("class");
  std::string at = given != nullptr ? given : childclass.empty() ? main_ : childclass;
  while (!at.empty()) {
    const auto known = classes_.find(at);
    if (known == classes_.end()) {
      return nullptr;
    }
    const std::vector<const XMLElement*>& places = known->second.elements;
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
      const XMLElement* here = (*place)->FirstChildElement(element.Name());
      if (here != nullptr && here->Attribute(name) != nullptr) {
        return here->Attribute(name);
      }
    }
    at = known->second.parent;
  }
  return nullptr;
}

}  // namespace plumbline::model
