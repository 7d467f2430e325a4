// URDF and SDFormat files with values exchanged in place.
#include <utility>

#include "simulator/model/skeleton_export.h"
#include "simulator/model/xml_text.h"
#include "simulator/trace/error.h"
#include "simulator/trace/file_text.h"

namespace plumbline::model {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

constexpr const char* kMoments[] = {"ixx", "ixy", "ixz", "iyy", "iyz", "izz"};
constexpr int kRow[] = {0, 0, 0, 1, 1, 2};
constexpr int kColumn[] = {0, 1, 2, 1, 2, 2};

std::string element(const std::string& name, const Attributes& attributes) {
  std::string text = "<" + name;
  for (const auto& [key, value] : attributes) {
    text += " " + key + "=\"" + value + "\"";
  }
  return text + "/>";
}

std::string element(const std::string& name, const std::string& content) {
  return "<" + name + ">" + content + "</" + name + ">";
}

const XmlNode& named(const XmlText& xml, const XmlNode& parent, const char* kind, const std::string& name,
                     const std::string& file) {
  for (const XmlNode* one : parent.all(kind)) {
    if (xml.value(*one, "name") == name) {
      return *one;
    }
  }
  throw InputError({file, 0, name}, "a name that is written in another way in the file",
                   "names without XML entities");
}

// --- URDF: values are attributes ---

/// The child's attributes, or a new child.
void put(XmlText& xml, const XmlNode& parent, const std::string& child, const Attributes& attributes,
         XmlText::Where where) {
  const XmlNode* node = parent.child(child);
  if (node == nullptr) {
    xml.insert(parent, {element(child, attributes)}, where);
    return;
  }
  for (const auto& [key, value] : attributes) {
    xml.set_attribute(*node, key, value);
  }
}

void put_urdf_body(XmlText& xml, const XmlNode& link, const Body& body) {
  Attributes moments;
  for (int i = 0; i < 6; ++i) {
    moments.emplace_back(kMoments[i], file_number(body.inertia(kRow[i], kColumn[i])));
  }
  const Attributes origin{{"xyz", file_vector(body.com)}, {"rpy", "0 0 0"}};
  const Attributes mass{{"value", file_number(body.mass)}};
  const XmlNode* inertial = link.child("inertial");
  if (inertial == nullptr) {
    xml.insert(link,
               {element("inertial",
                        element("origin", origin) + element("mass", mass) + element("inertia", moments))},
               XmlText::Where::first);
    return;
  }
  put(xml, *inertial, "origin", origin, XmlText::Where::first);
  put(xml, *inertial, "mass", mass, XmlText::Where::last);
  put(xml, *inertial, "inertia", moments, XmlText::Where::last);
}

// --- SDFormat: values are elements ---

/// Contents of the children; those that are missing are appended together.
void put(XmlText& xml, const XmlNode& parent, const Attributes& values) {
  std::vector<std::string> missing;
  for (const auto& [key, value] : values) {
    if (const XmlNode* node = parent.child(key)) {
      xml.set_content(*node, value);
    } else {
      missing.push_back(element(key, value));
    }
  }
  if (!missing.empty()) {
    xml.insert(parent, missing, XmlText::Where::last);
  }
}

void put_sdf_body(XmlText& xml, const XmlNode& link, const Body& body) {
  Attributes moments;
  std::string whole;
  for (int i = 0; i < 6; ++i) {
    moments.emplace_back(kMoments[i], file_number(body.inertia(kRow[i], kColumn[i])));
    whole += element(moments.back().first, moments.back().second);
  }
  const std::string pose = element("pose", file_vector(body.com) + " 0 0 0");
  const XmlNode* inertial = link.child("inertial");
  if (inertial == nullptr) {
    xml.insert(
        link,
        {element("inertial", pose + element("mass", file_number(body.mass)) + element("inertia", whole))},
        XmlText::Where::first);
    return;
  }
  if (const XmlNode* node = inertial->child("pose")) {
    xml.replace(*node, pose);
  } else {
    xml.insert(*inertial, {pose}, XmlText::Where::first);
  }
  xml.set_content(*inertial->child("mass"), file_number(body.mass));
  if (const XmlNode* inertia = inertial->child("inertia")) {
    put(xml, *inertia, moments);
  } else {
    xml.insert(*inertial, {element("inertia", whole)}, XmlText::Where::last);
  }
}

}  // namespace

std::string edited_urdf(const SkeletonEdit& edit) {
  const std::string& file = edit.before.file;
  XmlText xml(file, read_text(file));
  for (std::size_t b = 0; b < edit.bodies.size(); ++b) {
    if (edit.bodies[b]) {
      const Body& body = edit.after.bodies[b];
      put_urdf_body(xml, named(xml, xml.root(), "link", body.name, file), body);
    }
  }
  for (std::size_t j = 0; j < edit.joints.size(); ++j) {
    if (edit.joints[j]) {
      const JointValues& values = edit.after.joints[j];
      put(xml, named(xml, xml.root(), "joint", edit.before.joints[j].name, file), "dynamics",
          {{"damping", file_number(values.damping)}, {"friction", file_number(values.friction)}},
          XmlText::Where::last);
    }
  }
  return xml.edited();
}

std::string edited_sdf(const SkeletonEdit& edit) {
  const std::string& file = edit.before.file;
  XmlText xml(file, read_text(file));
  const XmlNode* world = xml.root().child("world");
  const XmlNode& model = *(world == nullptr ? xml.root() : *world).child("model");
  for (std::size_t b = 0; b < edit.bodies.size(); ++b) {
    if (edit.bodies[b]) {
      const Body& body = edit.after.bodies[b];
      put_sdf_body(xml, named(xml, model, "link", body.name, file), body);
    }
  }
  for (std::size_t j = 0; j < edit.joints.size(); ++j) {
    if (!edit.joints[j]) {
      continue;
    }
    const JointValues& values = edit.after.joints[j];
    const Attributes dynamics{{"damping", file_number(values.damping)},
                              {"friction", file_number(values.friction)}};
    const XmlNode& axis = *named(xml, model, "joint", edit.before.joints[j].name, file).child("axis");
    if (const XmlNode* node = axis.child("dynamics")) {
      put(xml, *node, dynamics);
    } else {
      xml.insert(axis,
                 {element("dynamics",
                          element("damping", dynamics[0].second) + element("friction", dynamics[1].second))},
                 XmlText::Where::last);
    }
  }
  if (edit.gravity) {
    xml.set_content(*(world == nullptr ? xml.root() : *world).child("gravity"),
                    file_vector(edit.after.gravity));
  }
  return xml.edited();
}

}  // namespace plumbline::model
