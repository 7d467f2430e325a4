// The model's feet: points, spheres, boxes and convex meshes of links.
#include <algorithm>

#include "simulator/mesh/mesh_file.h"
#include "simulator/mesh/mesh_mass.h"
#include "simulator/model/frames_in_file.h"
#include "simulator/model/kinds.h"
#include "simulator/model/model_sections.h"
#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;

constexpr const char* kTaken = "feet";  // group of the spheres that are taken from the skeleton

double length_unit(const YamlNode& entry) {
  const YamlNode unit = entry.at("unit");
  if (!units_agree(unit.text(), "m")) {
    unit.refuse("unit " + quote(unit.text()), "a unit like " + quote("m"));
  }
  return to_si_factor(unit.text());
}

double above_zero(const YamlNode& node) {
  const double value = node.number();
  if (!(value > 0.0)) {
    node.refuse("a number above zero");
  }
  return value;
}

int link_of(const YamlNode& entry, const Model& model) {
  const YamlNode link = entry.at("link");
  const std::vector<std::string> known = model.places(effects::Place::body);
  if (std::find(known.begin(), known.end(), link.text()) == known.end()) {
    link.refuse(quote(link.text()), "the name of a link of the skeleton" + nearest_names(link.text(), known));
  }
  return model.body_index(link.text());
}

/// The corners of a box whose edges lie along the link's axes, as feet of one group.
void add_box(const YamlNode& box, double scale, const Foot& centre, Model& model) {
  const Vector3d edges = scale * three(box, "the edges along the link's x, y and z");
  if (!(edges.minCoeff() > 0.0)) {
    box.refuse("an edge that is not above zero", "three edges above zero");
  }
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d side((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                        (corner & 4) != 0 ? 0.5 : -0.5);
    Foot foot = centre;
    foot.name = centre.name + "_" + std::to_string(corner + 1);
    foot.group = centre.group.empty() ? centre.name : centre.group;
    foot.point += side.cwiseProduct(edges);
    model.feet.push_back(foot);
  }
}

/// A closed and convex mesh that may serve as feet, in m.
mesh::Mesh convex_mesh(const YamlNode& node, double scale) {
  constexpr std::size_t kMostPoints = 200;  // each of them is asked in every evaluation
  constexpr double kFlat = 1e-4;            // of the mesh's size: what rounding leaves of a plane
  mesh::MeshFile read = mesh::read_mesh(beside(node.file(), node.text()), Vector3d::Constant(scale));
  if (!read.problem.empty()) {
    node.refuse(read.problem, "a mesh that can be used");
  }
  if (!mesh::is_closed(read.mesh)) {
    node.refuse("a mesh that is not closed", "the surface of a solid");
  }
  if (read.mesh.points.size() > kMostPoints) {
    node.refuse("a mesh of " + std::to_string(read.mesh.points.size()) + " points",
                "at most " + std::to_string(kMostPoints) + ": a coarser one");
  }
  Eigen::AlignedBox3d box;
  for (const Vector3d& point : read.mesh.points) {
    box.extend(point);
  }
  const double dent = mesh::largest_dent(read.mesh);
  if (dent > kFlat * box.sizes().maxCoeff()) {
    node.refuse("a mesh with a point " + number_text(dent, 3) + " m in front of one of its faces",
                "a convex one: its hull, or its parts");
  }
  return std::move(read.mesh);
}

/// The points of a convex mesh, whose axes are the link's, as feet of one group: on a plane nothing else of
/// it touches first.
void add_mesh(const YamlNode& node, double scale, const Foot& origin, Model& model) {
  int count = 0;
  for (const Vector3d& point : convex_mesh(node, scale).points) {
    Foot foot = origin;
    foot.name = origin.name + "_" + std::to_string(++count);
    foot.group = origin.group.empty() ? origin.name : origin.group;
    foot.point += point;
    model.feet.push_back(foot);
  }
}

Foot foot_of(const ContactSphere& sphere, const std::string& name) {
  Foot foot;
  foot.name = name;
  foot.body = sphere.body;
  foot.point = sphere.centre;
  foot.radius = sphere.radius;
  foot.source = sphere.shape.empty() ? "the skeleton's sphere " + sphere.name
                                     : "an end of the skeleton's capsule " + sphere.shape;
  return foot;
}

/// The two ends of a capsule, as feet of one group.
void add_capsule(const YamlNode& node, const std::string& name, const std::string& group, Model& model) {
  int ends = 0;
  for (const ContactSphere& sphere : skeleton_capsule(node, model)) {
    Foot foot = foot_of(sphere, name + "_" + std::to_string(++ends));
    foot.group = group.empty() ? name : group;
    model.feet.push_back(std::move(foot));
  }
}

void read_foot(const std::string& name, const YamlNode& entry, Model& model) {
  check_name(name, entry);
  std::string group;
  if (const auto given = entry.find("group")) {
    group = given->text();
    check_name(group, *given);
  }
  if (const auto sphere = entry.find("sphere")) {
    entry.allow_keys({"sphere", "group"});
    model.feet.push_back(foot_of(skeleton_sphere(*sphere, model), name));
    model.feet.back().group = group;
    return;
  }
  if (const auto capsule = entry.find("capsule")) {
    entry.allow_keys({"capsule", "group"});
    add_capsule(*capsule, name, group, model);
    return;
  }
  entry.allow_keys({"link", "value", "unit", "radius", "box", "mesh", "group", "source", "assumed"});
  Foot foot;
  foot.name = name;
  foot.body = link_of(entry, model);
  const double scale = length_unit(entry);
  foot.point = scale * three(entry.at("value"), "[x, y, z] in the link's frame");
  foot.source = read_origin(entry).text;
  foot.group = group;
  if (const auto radius = entry.find("radius")) {
    foot.radius = scale * above_zero(*radius);
  }
  if (const auto box = entry.find("box")) {
    add_box(*box, scale, foot, model);
    return;
  }
  if (const auto mesh = entry.find("mesh")) {
    add_mesh(*mesh, scale, foot, model);
    return;
  }
  model.feet.push_back(std::move(foot));
}

/// All spheres and ends of capsules of the skeleton, with laws in common.
void take_spheres(const YamlNode& node, Model& model) {
  if (node.text() != "take") {
    node.refuse(quote(node.text()), "take, or feet by name");
  }
  if (model.skeleton.spheres.empty()) {
    node.refuse("a skeleton without spheres or capsules that may touch the ground",
                "an MJCF file with such geoms, or feet by name");
  }
  for (const ContactSphere& sphere : model.skeleton.spheres) {
    model.feet.push_back(foot_of(sphere, sphere.name));
    model.feet.back().group = kTaken;
  }
}

void check_feet(const YamlNode& node, const Model& model) {
  for (std::size_t f = 0; f < model.feet.size(); ++f) {
    for (std::size_t g = 0; g < model.feet.size(); ++g) {
      const Foot& one = model.feet[f];
      const Foot& other = model.feet[g];
      if (f != g && (one.name == other.name || (one.name == other.group && one.group != other.group))) {
        node.refuse("two feet, or a foot and a group, called " + quote(one.name), "each name once");
      }
    }
  }
}

}  // namespace

std::array<ContactSphere, 2> skeleton_capsule(const YamlNode& name, const Model& model) {
  std::array<ContactSphere, 2> ends;
  std::vector<std::string> names;
  std::size_t found = 0;
  for (const ContactSphere& sphere : model.skeleton.spheres) {
    if (!sphere.shape.empty() && sphere.shape == name.text() && found < ends.size()) {
      ends[found++] = sphere;
    } else if (!sphere.shape.empty() && (names.empty() || names.back() != sphere.shape)) {
      names.push_back(sphere.shape);
    }
  }
  if (found < ends.size()) {
    name.refuse(quote(name.text()), "the name of a capsule of an MJCF skeleton that may touch the ground" +
                                        nearest_names(name.text(), names));
  }
  return ends;
}

const ContactSphere& skeleton_sphere(const YamlNode& name, const Model& model) {
  std::vector<std::string> names;
  for (const ContactSphere& sphere : model.skeleton.spheres) {
    if (sphere.name == name.text()) {
      return sphere;
    }
    names.push_back(sphere.name);
  }
  name.refuse(quote(name.text()), "the name of a sphere of an MJCF skeleton that may touch the ground" +
                                      nearest_names(name.text(), names));
}

void read_feet(const YamlNode& node, Model& model) {
  if (!node.is_map()) {
    take_spheres(node, model);
    return;
  }
  for (const auto& [name, entry] : node.entries()) {
    read_foot(name, entry, model);
  }
  check_feet(node, model);
}

}  // namespace plumbline::model
