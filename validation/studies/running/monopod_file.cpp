#include "validation/studies/running/monopod_file.h"

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::validation {
namespace {

using model::Model;
using model::YamlNode;

/// The text at a key, and where `known` knows no such part, what the model has instead.
template <class Known>
auto part(const YamlNode& node, const char* key, const std::string& expected, const Known& known) {
  const YamlNode at = node.at(key);
  const auto found = known(at.text());
  if (!found) {
    at.refuse(expected);
  }
  return *found;
}

monopod::Link link_of(const Model& model, const YamlNode& links, const char* key) {
  const int index =
      part(links, key, "a link of the model", [&](const std::string& name) -> std::optional<int> {
        const int body = model.body_index(name);
        return body < 0 ? std::nullopt : std::optional<int>(body);
      });
  const model::Body& body = model.skeleton.bodies[static_cast<std::size_t>(index)];
  return {body.mass, body.com.x(), body.com.z(), body.inertia(1, 1)};
}

double inertia_at(const Model& model, const YamlNode& transmission) {
  const model::Motor* const motor =
      part(transmission, "motor", "a motor of the model",
           [&](const std::string& name) -> std::optional<const model::Motor*> {
             const model::Motor* one = model.find_motor(name);
             return one == nullptr ? std::nullopt : std::optional<const model::Motor*>(one);
           });
  double sum = motor->rotor_inertia.value;
  for (const model::Inertia& inertia : model.inertias) {
    sum += inertia.at == transmission.at("motor").text() ? inertia.value.value : 0.0;
  }
  return sum;
}

const model::Ratio& ratio_of(const Model& model, const YamlNode& transmission) {
  return *part(transmission, "ratio", "a ratio of the model",
               [&](const std::string& name) -> std::optional<const model::Ratio*> {
                 const model::Ratio* one = model.find_ratio(name);
                 return one == nullptr ? std::nullopt : std::optional<const model::Ratio*>(one);
               });
}

/// How far below the upper link's frame a joint sits, m.
double length_below(const Model& model, const YamlNode& joint) {
  for (const model::Joint& one : model.skeleton.joints) {
    if (one.name == joint.text()) {
      return -one.X_PJ.translation().z();
    }
  }
  joint.refuse("a joint of the model");
}

double effect_value(const Model& model, const std::string& law, const std::string& at,
                    const std::string& parameter) {
  for (const model::EffectUse& use : model.effects) {
    if (use.law->declaration().name != law || use.at != at) {
      continue;
    }
    const auto& parameters = use.law->declaration().parameters;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (parameters[i].name == parameter) {
        return use.values[i].value;
      }
    }
  }
  return 0.0;
}

}  // namespace

MonopodModel read_monopod(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "monopod/1");
  root.allow_keys({"plumbline", "title", "model", "links", "knee", "angle", "shape"});
  MonopodModel read;
  MonopodNames& names = read.names;
  names.model = model::beside(path, root.at("model").text());
  const Model model = model::read_model(names.model, model::known_effects());
  monopod::Constants& c = read.constants;

  const YamlNode links = root.at("links");
  links.allow_keys({"body", "upper", "lower"});
  c.torso = link_of(model, links, "body");
  c.thigh = link_of(model, links, "upper");
  c.shin = link_of(model, links, "lower");
  c.upper_length = length_below(model, root.at("knee"));
  if (model.feet.empty()) {
    root.at("model").refuse("a model with a foot");
  }
  c.lower_length = -model.feet.front().point.z();

  const YamlNode angle = root.at("angle"), shape = root.at("shape");
  angle.allow_keys({"ratio", "motor"});
  shape.allow_keys({"ratio", "motor", "spring"});
  c.angle_ratio = ratio_of(model, angle).ratios.front().value;
  c.angle_inertia = inertia_at(model, angle);
  const model::Ratio& ratio = ratio_of(model, shape);
  c.shape_ratio = ratio.ratios.front().value;
  c.shape_inertia = inertia_at(model, shape);
  const std::string spring = shape.at("spring").text();
  for (std::size_t i = 1; i < ratio.to.size(); ++i) {
    // motor = ratio * leg shape + also * pulley
    c.spring_ratio = ratio.to[i].of == spring ? -c.shape_ratio / ratio.ratios[i].value : c.spring_ratio;
  }
  const model::Pulley* pulley = model.find_pulley(spring);
  if (pulley == nullptr || c.spring_ratio == 0.0) {
    shape.at("spring").refuse("a pulley of the model that stands in this ratio");
  }
  c.spring_inertia = pulley->inertia.value;
  c.spring_stiffness = effect_value(model, "spring", spring, "stiffness");
  c.spring_preload = effect_value(model, "preload", spring, "preload");
  c.spring_damping = effect_value(model, "viscous", spring, "damping");
  c.angle_friction = effect_value(model, "viscous", angle.at("motor").text(), "damping");
  c.shape_friction = effect_value(model, "viscous", shape.at("motor").text(), "damping");
  c.gravity = model.skeleton.gravity.norm();

  names.body = links.at("body").text();
  names.upper = links.at("upper").text();
  names.lower = links.at("lower").text();
  names.knee = root.at("knee").text();
  names.angle_ratio = angle.at("ratio").text();
  names.angle_motor = angle.at("motor").text();
  names.shape_ratio = shape.at("ratio").text();
  names.shape_motor = shape.at("motor").text();
  names.spring_pulley = spring;
  return read;
}

}  // namespace plumbline::validation
