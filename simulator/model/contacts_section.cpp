// The model's contacts: pairs of links that may meet each other.
#include <algorithm>

#include "simulator/model/frames_in_file.h"
#include "simulator/model/kinds.h"
#include "simulator/model/model_sections.h"
#include "simulator/model/quantity.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;

constexpr const char* kKnownPairs =
    "a point or sphere beside any shape, two capsules, or a capsule or a box on a plane";

double radius_of(const YamlNode& end, double scale, bool must) {
  const auto radius = end.find("radius");
  if (!radius && !must) {
    return 0.0;
  }
  const double value = end.at("radius").number();
  if (!(value > 0.0)) {
    radius->refuse("a number above zero");
  }
  return scale * value;
}

contact::Box read_box(const YamlNode& end, const YamlNode& edges, const Vector3d& centre, double scale) {
  contact::Box box;
  box.half = 0.5 * scale * three(edges, "the edges of the box");
  if (!(box.half.minCoeff() > 0.0)) {
    edges.refuse("an edge that is not above zero", "three edges above zero");
  }
  box.pose.translation() = centre;
  if (const auto turn = end.find("turn")) {
    box.pose.linear() = turned(*turn);
  }
  return box;
}

contact::Plane read_plane(const YamlNode& normal, const Vector3d& point) {
  const Vector3d direction = three(normal, "the direction out of the plane, in the link's frame");
  if (!(direction.norm() > 0.0)) {
    normal.refuse("a direction of zeros", "the direction out of the plane, in the link's frame");
  }
  return {point, direction.normalized()};
}

contact::Shape read_shape(const YamlNode& end) {
  const auto box = end.find("box");
  const auto plane = end.find("plane");
  const auto to = end.find("to");
  std::vector<std::string> keys{"link", "value", "unit"};
  const std::vector<std::string> own = box     ? std::vector<std::string>{"box", "turn"}
                                       : plane ? std::vector<std::string>{"plane"}
                                               : std::vector<std::string>{"to", "radius"};
  keys.insert(keys.end(), own.begin(), own.end());
  end.allow_keys(keys);
  const double scale = factor_of(end.at("unit"), "m");
  const Vector3d at = scale * three(end.at("value"), "[x, y, z] in the link's frame");
  if (box) {
    return read_box(end, *box, at, scale);
  }
  if (plane) {
    return read_plane(*plane, at);
  }
  contact::Round round{at, at, radius_of(end, scale, to.has_value())};
  if (to) {
    round.to = scale * three(*to, "[x, y, z] in the link's frame");
    if (round.is_ball()) {
      to->refuse("the same point as `value`", "the other end of the capsule's line");
    }
  }
  return round;
}

ContactEnd read_contact_end(const YamlNode& end, const Model& model) {
  if (const auto sphere = end.find("sphere")) {
    end.allow_keys({"sphere"});
    const ContactSphere& it = skeleton_sphere(*sphere, model);
    return {it.body, contact::Round{it.centre, it.centre, it.radius}};
  }
  if (const auto capsule = end.find("capsule")) {
    end.allow_keys({"capsule"});
    const std::array<ContactSphere, 2> ends = skeleton_capsule(*capsule, model);
    return {ends[0].body, contact::Round{ends[0].centre, ends[1].centre, ends[0].radius}};
  }
  return {link_or_world(end, model), read_shape(end)};
}

/// The link that a link is fixed to, by welds one after the other; -1: the world.
int carrier_of(const Skeleton& skeleton, int body) {
  for (auto joint = skeleton.joints.rbegin(); joint != skeleton.joints.rend(); ++joint) {
    if (joint->child == body && joint->type == JointType::fixed) {  // parents stand before their children
      body = joint->parent;
    }
  }
  return body;
}

LinkContact read_contact(const std::string& name, const YamlNode& entry, const Model& model) {
  check_name(name, entry);
  entry.allow_keys({"between", "source", "assumed"});
  LinkContact contact;
  contact.name = name;
  const YamlNode between = entry.at("between");
  const std::vector<YamlNode> ends = between.items();
  if (ends.size() != 2) {
    between.refuse(std::to_string(ends.size()) + (ends.size() == 1 ? " shape" : " shapes"), "two");
  }
  contact.ends = {read_contact_end(ends[0], model), read_contact_end(ends[1], model)};
  if (carrier_of(model.skeleton, contact.ends[0].body) == carrier_of(model.skeleton, contact.ends[1].body)) {
    between.refuse("both shapes on the same link, or on links that are fixed to each other",
                   "shapes of two links that move, or of one and the world");
  }
  const contact::Shape& one = contact.ends[0].shape;
  const contact::Shape& other = contact.ends[1].shape;
  if (contact::parts_that_meet(one, other).empty() && contact::parts_that_meet(other, one).empty()) {
    between.refuse("a " + contact::name_of(one) + " and a " + contact::name_of(other), kKnownPairs);
  }
  contact.source = read_origin(entry).text;
  return contact;
}

}  // namespace

void read_contacts(const YamlNode& node, Model& model) {
  const std::vector<std::string> feet = model.places(effects::Place::foot);
  for (const auto& [name, entry] : node.entries()) {
    const auto is_foot = [&, wanted = name](const Foot& foot) { return foot.name == wanted; };
    if (std::find(feet.begin(), feet.end(), name) != feet.end() ||
        std::any_of(model.feet.begin(), model.feet.end(), is_foot)) {
      entry.refuse("the name of a foot, " + quote(name), "a name of its own");
    }
    model.contacts.push_back(read_contact(name, entry, model));
  }
}

}  // namespace plumbline::model
