#include "simulator/model/skeleton_xml.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <sstream>

#include "simulator/model/rotation_vector.h"
#include "simulator/trace/file_text.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

using tinyxml2::XMLElement;

constexpr double kRounding = 1e-6;  // of published moments of inertia, as a share of the largest

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  const std::size_t last = text.find_last_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::string attribute(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::vector<const XMLElement*> children(const XMLElement& parent, const char* name) {
  std::vector<const XMLElement*> list;
  for (const XMLElement* e = parent.FirstChildElement(name); e != nullptr; e = e->NextSiblingElement(name)) {
    list.push_back(e);
  }
  return list;
}

int line_of(const std::vector<XmlPart>& parts, const std::string& name) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const XmlPart& part) { return part.name == name; });
  return found == parts.end() ? 0 : found->line;
}

std::optional<Eigen::Vector3d> three_numbers(const std::string& text) {
  std::istringstream words(text);
  Eigen::Vector3d numbers;
  words >> numbers.x() >> numbers.y() >> numbers.z();
  return words && numbers.allFinite() ? std::optional(numbers) : std::nullopt;
}

/// Reason why no rigid body has these moments, or an empty text.
std::string impossible(const Eigen::Matrix3d& inertia) {
  const Eigen::Vector3d principal = principal_moments(inertia);
  if (!(principal[0] > 0.0)) {
    return "a principal moment of " + number_text(principal[0], 6) + " kg m^2";
  }
  if (principal[2] > (principal[0] + principal[1]) * (1.0 + kRounding)) {
    return "principal moments " + number_text(principal[0], 6) + ", " + number_text(principal[1], 6) + ", " +
           number_text(principal[2], 6) + " kg m^2";
  }
  return "";
}

void remove_children(XMLElement& parent, const char* name) {
  while (XMLElement* child = parent.FirstChildElement(name)) {
    parent.DeleteChild(child);
  }
}

}  // namespace

SkeletonXml::SkeletonXml(const std::string& path) : file_(path) {
  const std::string text = read_text(path);
  if (document_.Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    throw InputError({file_, document_.ErrorLineNum(), ""},
                     std::string("text that is no XML (") + document_.ErrorName() + ")",
                     "a whole SDFormat or URDF file");
  }
  const XMLElement& model = find_model();
  if (urdf_) {
    state_world();
  }
  check_links(model);
  check_joints(model);
}

void SkeletonXml::refuse(const XmlPart& part, const std::string& found, const std::string& expected) const {
  throw InputError({file_, part.line, part.name}, found, expected);
}

int SkeletonXml::line_of_link(const std::string& name) const { return line_of(links_, name); }
int SkeletonXml::line_of_joint(const std::string& name) const { return line_of(joints_, name); }

bool SkeletonXml::has_link(const std::string& name) const {
  return std::any_of(links_.begin(), links_.end(), [&](const XmlPart& one) { return one.name == name; });
}

XmlPart SkeletonXml::part_in(const std::string& message) const {
  for (const std::vector<XmlPart>& parts : {joints_, links_}) {
    for (const XmlPart& part : parts) {
      if (message.find("[" + part.name + "]") != std::string::npos ||
          message.find("named " + part.name + " ") != std::string::npos) {
        return part;
      }
    }
  }
  return {};
}

void SkeletonXml::state_world() {
  XMLElement* robot = document_.RootElement();
  bool hangs = false;
  for (const XMLElement* joint : children(*robot, "joint")) {
    const XMLElement* parent = joint->FirstChildElement("parent");
    hangs = hangs || (parent != nullptr && attribute(*parent, "link") == "world");
  }
  for (const XMLElement* link : children(*robot, "link")) {
    hangs = hangs && attribute(*link, "name") != "world";
  }
  if (hangs) {
    robot->InsertFirstChild(document_.NewElement("link"))->ToElement()->SetAttribute("name", "world");
  }
}

const XMLElement& SkeletonXml::find_model() {
  const XMLElement* root = document_.RootElement();
  if (root == nullptr) {
    refuse({"", 1}, "no root element", "<sdf> or <robot>");
  }
  const std::string kind = root->Name();
  if (kind != "sdf" && kind != "robot") {
    refuse({"", root->GetLineNum()}, "root element <" + kind + ">", "<sdf> or <robot>");
  }
  urdf_ = kind == "robot";
  if (urdf_) {
    return *root;
  }
  const XMLElement* holder = root->FirstChildElement("world");
  holder = holder == nullptr ? root : holder;
  states_gravity_ = holder->FirstChildElement("gravity") != nullptr;
  const std::vector<const XMLElement*> worlds = children(*root, "world");
  const std::vector<const XMLElement*> models = children(*holder, "model");
  if (worlds.size() > 1 || models.size() != 1) {
    refuse({"", holder->GetLineNum()},
           std::to_string(worlds.size()) + " worlds and " + std::to_string(models.size()) + " models",
           "one model, alone or in one world");
  }
  for (const XMLElement* parent : {holder, models.front()}) {
    if (const XMLElement* include = parent->FirstChildElement("include")) {
      refuse({"include", include->GetLineNum()}, "an included model", "one model in one file");
    }
  }
  if (const XMLElement* nested = models.front()->FirstChildElement("model")) {
    refuse({attribute(*nested, "name"), nested->GetLineNum()}, "a model inside a model",
           "links and joints only");
  }
  if (models.front()->Attribute("placement_frame") != nullptr) {
    refuse({"placement_frame", models.front()->GetLineNum()}, "a placement frame", "the model's own pose");
  }
  return *models.front();
}

XmlPart SkeletonXml::named(const XMLElement& element, const std::vector<XmlPart>& taken) const {
  XmlPart part{attribute(element, "name"), element.GetLineNum()};
  if (trimmed(part.name).empty()) {
    refuse({element.Name(), part.line}, "no name", "the attribute name");
  }
  if (const int other = line_of(taken, part.name)) {
    refuse(part,
           std::string("a second ") + element.Name() + " of this name (the first is in line " +
               std::to_string(other) + ")",
           "each name once");
  }
  return part;
}

void SkeletonXml::check_links(const XMLElement& model) {
  for (const XMLElement* link : children(model, "link")) {
    const XmlPart part = named(*link, links_);
    links_.push_back(part);
    if (const XMLElement* inertial = link->FirstChildElement("inertial")) {
      if (is_massless(*inertial, part)) {
        massless_ = true;  // a frame: as if it had no inertial
        continue;
      }
      links_with_inertial_.insert(part.name);
      check_inertial(*inertial, part);
    }
  }
  if (links_.empty()) {
    refuse({"", model.GetLineNum()}, "no links", "at least one link");
  }
}

double SkeletonXml::number(const XMLElement& parent, const char* name, const XmlPart& part) const {
  const bool in_attribute = urdf_ && std::strcmp(parent.Name(), "inertia") == 0;
  const XMLElement* holder = in_attribute ? &parent : parent.FirstChildElement(name);
  const char* text = nullptr;
  if (holder != nullptr) {
    text = in_attribute ? holder->Attribute(name) : (urdf_ ? holder->Attribute("value") : holder->GetText());
  }
  const XmlPart place{part.name + " " + name, (holder == nullptr ? parent : *holder).GetLineNum()};
  if (text == nullptr) {
    const bool is_product = name[0] == 'i' && name[1] != name[2];
    return is_product && !urdf_ ? 0.0 : (refuse(place, "no value", "a number"), 0.0);
  }
  const std::optional<double> value = parse_number(trimmed(text));
  if (!value) {
    refuse(place, "\"" + std::string(text) + "\"", "a finite number");
  }
  return *value;
}

bool SkeletonXml::is_massless(const XMLElement& inertial, const XmlPart& link) const {
  return number(inertial, "mass", link) == 0.0;
}

std::string SkeletonXml::text() const {
  tinyxml2::XMLDocument copy;
  document_.DeepCopy(&copy);
  XMLElement* holder = copy.RootElement()->FirstChildElement("world");
  holder = holder == nullptr ? copy.RootElement() : holder;
  XMLElement* model = holder->FirstChildElement("model");
  for (XMLElement* link = model->FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    if (!has_inertial(attribute(*link, "name"))) {
      remove_children(*link, "inertial");
    }
  }
  tinyxml2::XMLPrinter printer;
  copy.Print(&printer);
  return printer.CStr();
}

Eigen::Vector3d SkeletonXml::triple(const XMLElement& element, const char* name, const XmlPart& link) const {
  const std::string text = attribute(element, name);
  const std::optional<Eigen::Vector3d> numbers = three_numbers(text.empty() ? "0 0 0" : text);
  if (!numbers) {
    refuse({link.name + " " + name, element.GetLineNum()}, "\"" + text + "\"", "three numbers");
  }
  return *numbers;
}

RigidPart SkeletonXml::urdf_part(const XMLElement& inertial, const Eigen::Matrix3d& inertia, double mass,
                                 const XmlPart& link) const {
  Eigen::Isometry3d X = Eigen::Isometry3d::Identity();
  if (const XMLElement* origin = inertial.FirstChildElement("origin")) {
    X.translation() = triple(*origin, "xyz", link);
    X.linear() = roll_pitch_yaw(triple(*origin, "rpy", link));
  }
  return placed({mass, Eigen::Vector3d::Zero(), inertia}, mass, X);
}

const RigidPart* SkeletonXml::unusual(const std::string& link) const {
  const auto found = unusual_.find(link);
  return found == unusual_.end() ? nullptr : &found->second;
}

void SkeletonXml::check_inertial(const XMLElement& inertial, const XmlPart& link) {
  const double mass = number(inertial, "mass", link);
  if (!(mass > 0.0)) {
    const int line = inertial.FirstChildElement("mass")->GetLineNum();
    refuse({link.name + " mass", line}, number_text(mass) + " kg", "a mass above zero");
  }
  const XMLElement* inertia = inertial.FirstChildElement("inertia");
  if (inertia == nullptr) {
    refuse({link.name + " inertia", inertial.GetLineNum()}, "no inertia",
           "ixx, iyy, izz and the products of inertia");
  }
  Eigen::Matrix3d I;  // entry by entry: a comma initializer must not be left by an exception
  I(0, 0) = number(*inertia, "ixx", link);
  I(1, 1) = number(*inertia, "iyy", link);
  I(2, 2) = number(*inertia, "izz", link);
  I(0, 1) = I(1, 0) = number(*inertia, "ixy", link);
  I(0, 2) = I(2, 0) = number(*inertia, "ixz", link);
  I(1, 2) = I(2, 1) = number(*inertia, "iyz", link);
  const std::string reason = impossible(I);
  if (!reason.empty() && urdf_) {
    unusual_[link.name] = urdf_part(inertial, I, mass, link);
  } else if (!reason.empty()) {
    refuse({link.name + " inertia", inertia->GetLineNum()}, reason,
           "moments above zero, none larger than the sum of the other two");
  }
}

void SkeletonXml::check_joints(const XMLElement& model) {
  for (const XMLElement* joint : children(model, "joint")) {
    const XmlPart part = named(*joint, joints_);
    joints_.push_back(part);
    check_joint(*joint, part);
    if (urdf_) {
      note_urdf_joint(*joint, part);
    }
  }
}

void SkeletonXml::check_joint(const XMLElement& joint, const XmlPart& part) const {
  const std::set<std::string> in_urdf{"revolute", "continuous", "prismatic", "fixed", "floating", "planar"};
  const std::set<std::string> in_sdf{"revolute", "continuous", "prismatic", "fixed", "ball", "universal"};
  const std::string type = attribute(joint, "type");
  if ((urdf_ ? in_urdf : in_sdf).count(type) == 0) {
    refuse(part, "joint type \"" + type + "\"",
           std::string("revolute, continuous, prismatic, fixed, ") +
               (urdf_ ? "floating or planar" : "ball or universal"));
  }
  if (urdf_) {
    check_urdf_joint(joint, part);
  }
}

void SkeletonXml::check_urdf_joint(const XMLElement& joint, const XmlPart& part) const {
  for (const char* end : {"parent", "child"}) {
    const XMLElement* element = joint.FirstChildElement(end);
    const std::string link = element == nullptr ? "" : attribute(*element, "link");
    if (!has_link(link)) {
      std::vector<std::string> names;
      for (const XmlPart& one : links_) {
        names.push_back(one.name);
      }
      refuse({part.name + " " + end, element == nullptr ? part.line : element->GetLineNum()},
             "\"" + link + "\"", "the name of a link" + nearest_names(link, names));
    }
  }
}

void SkeletonXml::note_urdf_joint(const XMLElement& joint, const XmlPart& part) {
  const std::string type = attribute(joint, "type");
  if (const XMLElement* stated = joint.FirstChildElement("mimic")) {
    Mimic mimic;
    mimic.joint = attribute(*stated, "joint");
    for (const auto& [key, value] : {std::pair<const char*, double*>{"multiplier", &mimic.multiplier},
                                     std::pair<const char*, double*>{"offset", &mimic.offset}}) {
      if (stated->Attribute(key) != nullptr &&
          stated->QueryDoubleAttribute(key, value) != tinyxml2::XML_SUCCESS) {
        refuse({part.name + " mimic " + key, stated->GetLineNum()}, "\"" + attribute(*stated, key) + "\"",
               "a number");
      }
    }
    mimics_[part.name] = mimic;
  }
  if (type == "floating") {
    floating_.insert(part.name);
  }
  if (type != "planar") {
    return;
  }
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  // URDF's axis where none is given
  if (const XMLElement* axis = joint.FirstChildElement("axis")) {
    normal = three_numbers(attribute(*axis, "xyz")).value_or(Eigen::Vector3d::Zero());
    if (!(normal.norm() > 0.0)) {
      refuse({part.name + " axis", axis->GetLineNum()}, "\"" + attribute(*axis, "xyz") + "\"",
             "three numbers that are not all zero");
    }
  }
  planar_[part.name] = normal.normalized();
}

UrdfJoint SkeletonXml::urdf_joint(const std::string& name) const {
  return floating_.count(name) != 0 ? UrdfJoint::floating
         : planar_.count(name) != 0 ? UrdfJoint::planar
                                    : UrdfJoint::single;
}

const SkeletonXml::Mimic* SkeletonXml::mimic(const std::string& name) const {
  const auto found = mimics_.find(name);
  return found == mimics_.end() ? nullptr : &found->second;
}

Eigen::Vector3d SkeletonXml::planar_normal(const std::string& name) const { return planar_.at(name); }

void SkeletonXml::keep_fixed_joints(XMLElement& robot) {
  for (XMLElement* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    if (urdf_joint(attribute(*joint, "name")) != UrdfJoint::single) {
      joint->SetAttribute("type", "fixed");
    }
    if (attribute(*joint, "type") == "fixed") {
      XMLElement* extension = document_.NewElement("gazebo");
      extension->SetAttribute("reference", joint->Attribute("name"));
      XMLElement* keep = document_.NewElement("preserveFixedJoint");
      keep->SetText("true");
      extension->InsertEndChild(keep);
      robot.InsertEndChild(extension);
    }
  }
}

std::string SkeletonXml::joint_name(const std::string& read) const {
  const auto found = renamed_.find(read);
  return found == renamed_.end() ? read : found->second;
}

std::string SkeletonXml::urdf_for_sdformat(UrdfShapes shapes) {
  XMLElement& robot = *document_.RootElement();
  for (const char* extension : {"gazebo", "transmission"}) {
    remove_children(robot, extension);
  }
  if (shapes == UrdfShapes::left_out) {
    remove_children(robot, "material");
  }
  for (XMLElement* link = robot.FirstChildElement("link"); link != nullptr;
       link = link->NextSiblingElement("link")) {
    if (shapes == UrdfShapes::left_out) {
      remove_children(*link, "visual");
    }
    remove_children(*link, "collision");
    const std::string name = attribute(*link, "name");
    if (!has_inertial(name) || unusual(name) != nullptr) {
      remove_children(*link, "inertial");
    }
    if (link->FirstChildElement("inertial") == nullptr && attribute(*link, "name") != "world") {
      tinyxml2::XMLDocument placeholder;
      placeholder.Parse(
          "<inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>");
      link->InsertEndChild(placeholder.RootElement()->DeepClone(&document_));
    }
  }
  for (XMLElement* joint = robot.FirstChildElement("joint"); joint != nullptr;
       joint = joint->NextSiblingElement("joint")) {
    const std::string name = attribute(*joint, "name");
    if (has_link(name)) {
      const std::string other = name + "__joint";
      renamed_[other] = name;
      joint->SetAttribute("name", other.c_str());
    }
  }
  keep_fixed_joints(robot);
  tinyxml2::XMLPrinter printer;
  document_.Print(&printer);
  return printer.CStr();
}

}  // namespace plumbline::model
