// The model's closed loops.
#include <algorithm>

#include "simulator/model/frames_in_file.h"
#include "simulator/model/kinds.h"
#include "simulator/model/model_sections.h"
#include "simulator/model/plain_number.h"
#include "simulator/model/quantity.h"
#include "simulator/trace/units.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;

constexpr const char* kWorld = "world";

Loop::Type type_of(const YamlNode& entry) {
  const YamlNode type = entry.at("type");
  for (const Loop::Type known : {Loop::Type::connect, Loop::Type::hinge, Loop::Type::weld, Loop::Type::rod}) {
    if (type.text() == to_string(known)) {
      return known;
    }
  }
  type.refuse("connect, hinge, weld or rod");
}

/// Axes whose z is the given direction; which way x lies is of no matter.
Eigen::Matrix3d about(const YamlNode& axis) {
  const Vector3d direction = three(axis, "the hinge's axis in the link's frame");
  if (!(direction.norm() > 0.0)) {
    axis.refuse("an axis of zeros", "the direction of the hinge in the link's frame");
  }
  return Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), direction).toRotationMatrix();
}

LoopEnd read_end(const YamlNode& node, Loop::Type type, const Model& model) {
  node.allow_keys(type == Loop::Type::hinge  ? std::vector<std::string>{"link", "value", "unit", "axis"}
                  : type == Loop::Type::weld ? std::vector<std::string>{"link", "value", "unit", "turn"}
                                             : std::vector<std::string>{"link", "value", "unit"});
  LoopEnd end;
  end.body = link_or_world(node, model);
  end.point = factor_of(node.at("unit"), "m") * three(node.at("value"), "[x, y, z] in the link's frame");
  if (type == Loop::Type::hinge) {
    end.axes = about(node.at("axis"));
  } else if (const auto turn = node.find("turn")) {
    end.axes = turned(*turn);
  }
  return end;
}

void read_near(const YamlNode& near, Model& model) {
  const std::vector<std::string> joints = joint_names(model.skeleton);
  for (const auto& [name, value] : near.entries()) {
    if (std::find(joints.begin(), joints.end(), name) == joints.end()) {
      value.refuse(quote(name), "the name of a joint that moves" + nearest_names(name, joints));
    }
    const auto same = [&, wanted = name](const Lock& one) { return one.at == wanted; };
    model.loops_near.erase(std::remove_if(model.loops_near.begin(), model.loops_near.end(), same),
                           model.loops_near.end());
    model.loops_near.push_back({name, read_number(value, position_unit(is_angular(model, name)))});
  }
}

Loop read_loop(const std::string& name, const YamlNode& entry, const Model& model) {
  check_name(name, entry);
  Loop loop;
  loop.name = name;
  loop.file = entry.file();
  loop.line = entry.line();
  loop.type = type_of(entry);
  std::vector<std::string> keys{"type", "between", "source", "assumed"};
  if (loop.type == Loop::Type::rod) {
    keys.emplace_back("length");
    const YamlNode length = entry.at("length");
    loop.length = read_quantity(length, {"m", QuantityRule::Sign::positive, false, {}}).value;
  }
  entry.allow_keys(keys);
  read_origin(entry);
  const YamlNode between = entry.at("between");
  const std::vector<YamlNode> ends = between.items();
  if (ends.size() != 2) {
    between.refuse(std::to_string(ends.size()) + (ends.size() == 1 ? " end" : " ends"), "two");
  }
  loop.ends = {read_end(ends[0], loop.type, model), read_end(ends[1], loop.type, model)};
  if (loop.ends[0].body == loop.ends[1].body) {
    between.refuse("both ends on the same link", "points of two links, or of a link and the world");
  }
  return loop;
}

}  // namespace

int link_or_world(const YamlNode& node, const Model& model) {
  const YamlNode link = node.at("link");
  if (link.text() == kWorld) {
    return -1;
  }
  std::vector<std::string> known = model.places(effects::Place::body);
  if (std::find(known.begin(), known.end(), link.text()) == known.end()) {
    known.emplace_back(kWorld);
    link.refuse(quote(link.text()), "the name of a link of the skeleton" + nearest_names(link.text(), known));
  }
  return model.body_index(link.text());
}

void read_loops(const YamlNode& node, Model& model) {
  for (const auto& [name, entry] : node.entries()) {
    if (name == "near") {
      read_near(entry, model);
      continue;
    }
    const auto same = [&, wanted = name](const Loop& loop) { return loop.name == wanted; };
    if (std::any_of(model.loops.begin(), model.loops.end(), same)) {
      entry.refuse("loop " + quote(name) + ", which the skeleton closes already", "the name of a new loop");
    }
    model.loops.push_back(read_loop(name, entry, model));
  }
}

}  // namespace plumbline::model
