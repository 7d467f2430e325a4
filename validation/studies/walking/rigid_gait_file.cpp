#include <algorithm>

#include "simulator/model/known_effects.h"
#include "simulator/model/quantity.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "validation/studies/walking/rigid_gait.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;
using Sign = model::QuantityRule::Sign;

double number(const YamlNode& node, const char* unit) {
  return model::read_quantity(node, {unit, Sign::any, false, {}}).value;
}

GaitLeg read_leg(const YamlNode& node) {
  GaitLeg leg;
  const std::vector<std::pair<std::string, std::string*>> keys{{"foot", &leg.foot},
                                                               {"angle", &leg.angle},
                                                               {"shape", &leg.shape},
                                                               {"angle_motor", &leg.angle_motor},
                                                               {"shape_motor", &leg.shape_motor},
                                                               {"spring", &leg.spring}};
  std::vector<std::string> known;
  for (const auto& [key, to] : keys) {
    known.push_back(key);
    *to = node.at(key).text();
  }
  node.allow_keys(known);
  return leg;
}

// The same constants that the controller takes: a gait is one file.
controllers::WalkingGait read_gait(const std::string& path, std::array<double, 4>& kp,
                                   std::array<double, 4>& kd) {
  const std::vector<YamlNode> chain = model::read_chain(path, "controller/2");
  controllers::WalkingGait gait;
  std::vector<controllers::GaitNumber> numbers = controllers::numbers_of(gait);
  const char* const kp_names[] = {"kp_stance_shape", "kp_swing_angle", "kp_swing_shape", "kp_torso"};
  const char* const kd_names[] = {"kd_stance_shape", "kd_swing_angle", "kd_swing_shape", "kd_torso"};
  for (std::size_t i = 0; i < 4; ++i) {
    numbers.push_back({kp_names[i], "N m/rad", &kp[i]});
    numbers.push_back({kd_names[i], "N m s/rad", &kd[i]});
  }
  for (const controllers::GaitNumber& one : numbers) {
    bool stated = false;
    for (const YamlNode& document : chain) {  // what changes stands before what it changes
      const auto constants = document.find("constants");
      const auto node = constants ? constants->find(one.name) : std::nullopt;
      if (node) {
        *one.value = number(*node, one.unit);
        stated = true;
        break;
      }
    }
    if (!stated) {
      throw InputError(path + ": constants: found no '" + one.name + "', expected it of a walking gait");
    }
  }
  controllers::place_curves(gait);
  return gait;
}

}  // namespace

RigidGait read_rigid_gait(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "rigid_gait/1");
  root.allow_keys({"plumbline", "title", "model", "controller", "stance", "swing", "trunk", "base",
                   "exchange", "start", "mass", "published", "impact_scales"});
  RigidGait gait;
  gait.file = path;
  gait.model_file = model::beside(path, root.at("model").text());
  gait.gait_file = model::beside(path, root.at("controller").text());
  gait.model = model::read_model(gait.model_file, model::known_effects());
  std::vector<model::EffectUse>& effects = gait.model.effects;
  effects.erase(
      std::remove_if(effects.begin(), effects.end(),
                     [](const model::EffectUse& use) { return use.law->sits_at(effects::Place::foot); }),
      effects.end());
  gait.gait = read_gait(gait.gait_file, gait.kp, gait.kd);
  gait.stance = read_leg(root.at("stance"));
  gait.swing = read_leg(root.at("swing"));
  gait.torso = root.at("trunk").text();
  const std::vector<YamlNode> base = root.at("base").items();
  if (base.size() != 2) {
    root.at("base").refuse("two coordinates: forward, up");
  }
  gait.base = {base[0].text(), base[1].text()};
  for (const auto& [one, other] : root.at("exchange").entries()) {
    gait.exchanged.emplace_back(one, other.text());
  }
  const YamlNode start = root.at("start");
  start.allow_keys({"theta_rate", "spring", "spring_rate"});
  gait.start = {{"theta_rate", number(start.at("theta_rate"), "rad/s")},
                {"spring", number(start.at("spring"), "rad")},
                {"spring_rate", number(start.at("spring_rate"), "rad/s")}};
  gait.mass = model::read_quantity(root.at("mass"), {"kg", Sign::positive, false, {}}).value;
  if (const auto published = root.find("published")) {
    for (const auto& [name, node] : published->entries()) {
      if (name == "curves") {
        gait.curves = model::beside(path, node.text());
      } else {
        const char* unit = name == "step_time"     ? "s"
                           : name == "step_length" ? "m"
                           : name == "speed"       ? "m/s"
                                                   : "1";
        gait.published[name] = number(node, unit);
      }
    }
  }
  if (const auto scales = root.find("impact_scales")) {
    for (const YamlNode& item : scales->items()) {
      item.allow_keys({"scale", "speed"});
      gait.impact_scales.push_back({number(item.at("scale"), "1"), number(item.at("speed"), "m/s")});
    }
  }
  return gait;
}

}  // namespace plumbline::validation
