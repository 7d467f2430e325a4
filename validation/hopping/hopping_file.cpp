#include "validation/hopping/hopping_file.h"

#include <cmath>
#include <optional>
#include <vector>

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/table.h"

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;
using model::YamlNode;
using Sign = model::QuantityRule::Sign;

constexpr const char* kFormat = "controller/1";
constexpr const char* kFound = "found by search";

/// A number of a section and where it goes.
struct Entry {
  const char* key;
  const char* unit;
  double* value;
};

/// What a document must state: everything, or, above a base, only what it changes.
enum class Extent { whole, changes };

double read_number(const YamlNode& node, const char* unit) {
  return model::read_quantity(node, {unit, Sign::any, false, {}}).value;
}

std::optional<YamlNode> entry_of(const YamlNode& node, const char* key, Extent extent) {
  return extent == Extent::whole ? node.at(key) : node.find(key);
}

void read_entries(const YamlNode& node, Extent extent, const std::vector<Entry>& entries,
                  std::vector<std::string> others) {
  for (const Entry& entry : entries) {
    others.emplace_back(entry.key);
  }
  node.allow_keys(others);
  for (const Entry& entry : entries) {
    if (const auto stated = entry_of(node, entry.key, extent)) {
      *entry.value = read_number(*stated, entry.unit);
    }
  }
}

void read_parameters(const YamlNode& node, Extent extent, controllers::HoppingParameters& p) {
  read_entries(node, extent,
               {{"delta_LA", "rad", &p.delta_LA},
                {"h_T0", "rad", &p.h_T0},
                {"h_LS_left", "rad", &p.h_LS_left},
                {"h_LS_right", "rad", &p.h_LS_right},
                {"delta_LS_minus_left", "rad", &p.delta_LS_minus_left},
                {"delta_LS_minus_right", "rad", &p.delta_LS_minus_right},
                {"delta_LS_plus_left", "rad", &p.delta_LS_plus_left},
                {"delta_LS_plus_right", "rad", &p.delta_LS_plus_right},
                {"gamma_LA_to_mLA", "1", &p.gamma_LA_to_mLA},
                {"gamma_LS_to_mLS", "1", &p.gamma_LS_to_mLS},
                {"hip_velocity_band", "m/s", &p.hip_velocity_band},
                {"retract_time", "s", &p.retract_time}},
               {});
}

void read_update(const YamlNode& node, Extent extent, controllers::HoppingParameters& p) {
  p.event_update = true;
  read_entries(node, extent,
               {{"K_T", "1", &p.K_T},
                {"delta_phi_d", "rad", &p.delta_phi_d},
                {"delta_h_T_limit", "rad", &p.delta_h_T_limit}},
               {});
}

void read_gains(const YamlNode& node, Extent extent, controllers::HoppingLegGains& gains) {
  read_entries(node, extent,
               {{"kp_LA", "N m/rad", &gains.kp_LA},
                {"kd_LA", "N m s/rad", &gains.kd_LA},
                {"kp_mLS", "N m/rad", &gains.kp_mLS},
                {"kd_mLS", "N m s/rad", &gains.kd_mLS}},
               {});
}

/// A whole number that an int can hold; what else it must be is the controller's to say.
void read_count(const YamlNode& section, Extent extent, const char* key, int& count) {
  constexpr double kMost = 1e6;
  if (const auto stated = entry_of(section, key, extent)) {
    const double number = read_number(*stated, "1");
    if (!(std::abs(number) <= kMost) || number != std::floor(number)) {
      stated->refuse(number_text(number), "a whole number of at most 1000000");
    }
    count = static_cast<int>(number);
  }
}

void read_filter(const YamlNode& node, Extent extent, controllers::RateFilterOptions& filter) {
  read_entries(node, extent, {{"time_constant", "s", &filter.time_constant}}, {"samples", "order"});
  read_count(node, extent, "samples", filter.samples);
  read_count(node, extent, "order", filter.order);
}

void read_supplements(const YamlNode& node, Extent extent, controllers::HoppingSupplements& s) {
  read_entries(node, extent,
               {{"touchdown_time_min", "s", &s.touchdown_time_min},
                {"bounce_time", "s", &s.bounce_time},
                {"kickoff_time_max", "s", &s.kickoff_time_max},
                {"liftoff_time_max", "s", &s.liftoff_time_max}},
               {"contact_samples"});
  read_count(node, extent, "contact_samples", s.contact_samples);
}

void read_workspace(const YamlNode& node, Extent extent, controllers::HoppingWorkspace& w) {
  read_entries(node, extent,
               {{"leg_angle_from", "rad", &w.leg_angle_from},
                {"leg_angle_to", "rad", &w.leg_angle_to},
                {"leg_shape_from", "rad", &w.leg_shape_from},
                {"leg_shape_to", "rad", &w.leg_shape_to}},
               {});
}

void read_leg_angle(const YamlNode& root, Extent extent, const char* key,
                    controllers::LegAngleSource& source) {
  if (const auto stated = entry_of(root, key, extent)) {
    const std::string text = stated->text();
    if (text != "joints" && text != "motor") {
      stated->refuse("joints or motor");
    }
    source = text == "motor" ? controllers::LegAngleSource::motor : controllers::LegAngleSource::joints;
  }
}

/// A section, whose reader is given what it goes into.
template <class Target>
void read_section(const YamlNode& root, Extent extent, const char* key,
                  void (*read)(const YamlNode&, Extent, Target&), Target& target) {
  if (const auto section = entry_of(root, key, extent)) {
    read(*section, extent, target);
  }
}

void read_document(const YamlNode& root, Extent extent, HoppingConfig& config) {
  if (root.has("controller") || extent == Extent::whole) {
    const YamlNode controller = root.at("controller");
    if (controller.text() != "hopping") {
      controller.refuse("hopping");
    }
  }
  read_entries(root, extent,
               {{"period", "s", &config.period},
                {"boom_length", "m", &config.boom_length},
                {"torque_limit_mLA", "N m", &config.torque_limit_mLA},
                {"torque_limit_mLS", "N m", &config.torque_limit_mLS}},
               {"plumbline", "base", "controller", "title", "note", "parameters", "event_update", "left",
                "right", "leg_angle", "leg_angle_rate", "leg_angle_filter", "leg_shape_filter", "hip_filter",
                "supplements", "workspace"});
  read_section(root, extent, "parameters", read_parameters, config.parameters);
  if (const auto update = root.find("event_update")) {
    read_update(*update, config.parameters.event_update ? extent : Extent::whole, config.parameters);
  }
  read_section(root, extent, "left", read_gains, config.left);
  read_section(root, extent, "right", read_gains, config.right);
  read_leg_angle(root, extent, "leg_angle", config.leg_angle);
  read_leg_angle(root, extent, "leg_angle_rate", config.leg_angle_rate);
  read_section(root, extent, "leg_angle_filter", read_filter, config.leg_angle_filter);
  read_section(root, extent, "leg_shape_filter", read_filter, config.leg_shape_filter);
  read_section(root, extent, "hip_filter", read_filter, config.hip_filter);
  read_section(root, extent, "supplements", read_supplements, config.supplements);
  if (const auto workspace = root.find("workspace")) {
    read_workspace(*workspace, extent, config.workspace);
  }
}

void emit_gains(YAML::Emitter& out, const char* side, const controllers::HoppingLegGains& gains) {
  out << YAML::Key << side << YAML::Value << YAML::BeginMap;
  model::emit_quantity(out, "kp_LA", {gains.kp_LA, "N m/rad", 0.0, "assumed", kFound});
  model::emit_quantity(out, "kd_LA", {gains.kd_LA, "N m s/rad", 0.0, "assumed", kFound});
  model::emit_quantity(out, "kp_mLS", {gains.kp_mLS, "N m/rad", 0.0, "assumed", kFound});
  model::emit_quantity(out, "kd_mLS", {gains.kd_mLS, "N m s/rad", 0.0, "assumed", kFound});
  out << YAML::EndMap;
}

void emit_one(YAML::Emitter& out, const char* section, const char* key, double value) {
  out << YAML::Key << section << YAML::Value << YAML::BeginMap;
  model::emit_quantity(out, key, {value, "1", 0.0, "assumed", kFound});
  out << YAML::EndMap;
}

}  // namespace

HoppingConfig read_hopping(const std::string& path) {
  const std::vector<YamlNode> chain = model::read_chain(path, kFormat);
  HoppingConfig config;
  for (auto document = chain.rbegin(); document != chain.rend(); ++document) {
    read_document(*document, document == chain.rbegin() ? Extent::whole : Extent::changes, config);
  }
  return config;
}

void write_gains(const std::string& path, const std::string& base_file, const HoppingConfig& config,
                 const std::string& note) {
  YAML::Emitter out;
  model::begin_overlay(out, path, kFormat, base_file, note);
  emit_gains(out, "left", config.left);
  emit_gains(out, "right", config.right);
  if (config.parameters.event_update) {
    emit_one(out, "event_update", "K_T", config.parameters.K_T);
  }
  emit_one(out, "leg_angle_filter", "samples", config.leg_angle_filter.samples);
  emit_one(out, "leg_shape_filter", "samples", config.leg_shape_filter.samples);
  out << YAML::EndMap;
  write_text_atomically(path, std::string(out.c_str()) + "\n");
}

}  // namespace plumbline::validation
