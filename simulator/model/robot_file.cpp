#include "simulator/model/robot_file.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "simulator/model/correlations_section.h"
#include "simulator/model/effect_list.h"
#include "simulator/model/from_data_sheets.h"
#include "simulator/model/joint_chain.h"
#include "simulator/model/model_sections.h"
#include "simulator/model/robot_reader.h"
#include "simulator/model/yaml_chain.h"

namespace plumbline::model {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "model/1";

std::string skeleton_path(const YamlNode& node) {
  const std::string extension = fs::path(node.text()).extension().string();
  if (extension != ".sdf" && extension != ".urdf" && extension != ".xml") {
    node.refuse("a file name that ends in .sdf, .urdf or .xml (MJCF)");
  }
  std::string path = beside(node.file(), node.text());
  std::error_code missing;
  if (!fs::is_regular_file(path, missing)) {
    node.refuse(quote(node.text()) + ", where there is no file",
                "the path of a .sdf, .urdf or .xml, relative to this file");
  }
  return path;
}

void read_section(const YamlNode& root, const char* key, void (*read)(const YamlNode&, Model&),
                  Model& model) {
  if (const auto section = root.find(key)) {
    read(*section, model);
  }
}

/// That of the outermost file of the chain that names one: an overlay's skeleton replaces its base's.
Skeleton read_skeleton_of(const std::vector<YamlNode>& chain, const SkeletonReader& skeletons) {
  for (const YamlNode& document : chain) {
    if (const auto skeleton = document.find("skeleton")) {
      return skeletons(skeleton_path(*skeleton));
    }
  }
  return skeletons(skeleton_path(chain.back().at("skeleton")));  // refuses: the base has none
}

void read_floating_base(const YamlNode& node, Model& model) {
  if (node.flag() && !free_base(model.skeleton)) {
    node.refuse("a floating base of a skeleton that hangs on the world by joints of its own",
                "one root link that no joint leads to");
  }
  check_joint_names(model.skeleton);
}

/// Joints that mimic another one in the skeleton, as ties, where the model states none of them itself.
void tie_mimics(const YamlNode& root, Model& model) {
  for (const Joint& joint : model.skeleton.joints) {
    const bool stated = std::any_of(model.ratios.begin(), model.ratios.end(),
                                    [&](const Ratio& ratio) { return ratio.motor == joint.name; });
    if (joint.mimics.empty() || stated) {
      continue;
    }
    const auto master =
        std::find_if(model.coordinates.begin(), model.coordinates.end(), [&](const Coordinate& coordinate) {
          return coordinate.terms.size() == 1 && coordinate.terms.front().of == joint.mimics;
        });
    if (master == model.coordinates.end()) {
      root.refuse("no coordinate of joint " + quote(joint.mimics) + " alone, which " + quote(joint.name) +
                      " mimics in the skeleton",
                  "such a coordinate, or the joint tied under `ratios`");
    }
    Quantity ratio;
    ratio.value = joint.follows / master->terms.front().factor;
    ratio.source = "<mimic> of the skeleton";
    model.ratios.push_back({joint.name, joint.name, {{master->name, ratio.value}}, {ratio}});
  }
}

Model read_base(const YamlNode& root, const effects::Catalogue& catalogue, Skeleton skeleton) {
  root.allow_keys({"plumbline", "robot", "skeleton", "floating_base", "gravity", "masses", "coordinates",
                   "motors", "pulleys", "ratios", "inertias", "sensors", "feet", "contacts", "loops",
                   "effects", "correlations", "joint_dynamics"});
  Model model;
  model.file = root.file();
  model.robot = root.at("robot").text();
  model.skeleton = std::move(skeleton);
  read_section(root, "floating_base", read_floating_base, model);
  read_section(root, "gravity", read_gravity, model);
  read_section(root, "masses", read_masses, model);
  read_section(root, "pulleys", read_pulleys, model);
  read_section(root, "coordinates", read_coordinates, model);
  read_section(root, "motors", read_motors, model);
  check_names(root, model);
  read_section(root, "ratios", read_ratios, model);
  check_ratios(root, model);
  tie_mimics(root, model);
  read_section(root, "inertias", read_inertias, model);
  read_section(root, "feet", read_feet, model);
  read_section(root, "contacts", read_contacts, model);
  model.loops = model.skeleton.loops;
  for (const Joint& joint : model.skeleton.joints) {
    if (joint.reference != 0.0 && !model.loops.empty()) {
      model.loops_near.push_back({joint.name, joint.reference});  // the file's pose, unless `near` says more
    }
  }
  read_section(root, "loops", read_loops, model);
  read_section(root, "sensors", read_sensors, model);
  if (const auto effects = root.find("effects")) {
    read_effects(*effects, catalogue, model);
  }
  if (const auto motors = root.find("motors")) {
    add_back_emf(*motors, catalogue, model);
  }
  if (const auto dynamics = root.find("joint_dynamics")) {
    take_joint_dynamics(*dynamics, catalogue, model);
  }
  read_section(root, "correlations", read_correlations, model);
  return model;
}

}  // namespace

void apply_overlay(const YamlNode& overlay, const effects::Catalogue& catalogue, Model& model) {
  overlay.allow_keys(
      {"plumbline", "base", "note", "skeleton", "sensors", "effects", "values", "correlations"});
  if (const auto note = overlay.find("note")) {
    note->text();
  }
  if (const auto sensors = overlay.find("sensors")) {
    for (const auto& [name, entry] : sensors->entries()) {
      if (model.find_sensor(name) != nullptr) {
        entry.refuse("sensor " + quote(name) + ", which the base has", "the name of a new sensor");
      }
    }
    read_sensors(*sensors, model);
  }
  if (const auto effects = overlay.find("effects")) {
    read_effects(*effects, catalogue, model);
  }
  if (const auto values = overlay.find("values")) {
    replace_values(*values, model);
  }
  read_section(overlay, "correlations", read_correlations, model);
}

Model read_model(const std::string& path, const effects::Catalogue& catalogue,
                 const SkeletonReader& skeletons) {
  const std::vector<YamlNode> chain = read_chain(path, kFormat);
  Model model = read_base(chain.back(), catalogue, read_skeleton_of(chain, skeletons));
  for (auto document = chain.rbegin(); document != chain.rend(); ++document) {
    if (document != chain.rbegin()) {
      apply_overlay(*document, catalogue, model);
    }
    model.lineage.push_back(document->file());
  }
  model.file = path;
  return model;
}

Model read_model(const std::string& path, const effects::Catalogue& catalogue) {
  return read_model(path, catalogue, read_skeleton);
}

}  // namespace plumbline::model
