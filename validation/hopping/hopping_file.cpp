#include "validation/hopping/hopping_file.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/number_text.h"

namespace plumbline::validation {
namespace {

using controllers::HoppingConfig;
using model::YamlNode;
using Sign = model::QuantityRule::Sign;

/// A number of a section and where it goes.
struct Entry {
  const char* key;
  const char* unit;
  double* value;
};

double read_number(const YamlNode& node, const char* unit) {
  return model::read_quantity(node, {unit, Sign::any, false, {}}).value;
}

void read_entries(const YamlNode& node, const std::vector<Entry>& entries, std::vector<std::string> others) {
  for (const Entry& entry : entries) {
    others.emplace_back(entry.key);
  }
  node.allow_keys(others);
  for (const Entry& entry : entries) {
    *entry.value = read_number(node.at(entry.key), entry.unit);
  }
}

void read_parameters(const YamlNode& node, controllers::HoppingParameters& p) {
  read_entries(node,
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

void read_update(const YamlNode& node, controllers::HoppingParameters& p) {
  p.event_update = true;
  read_entries(node,
               {{"K_T", "1", &p.K_T},
                {"delta_phi_d", "rad", &p.delta_phi_d},
                {"delta_h_T_limit", "rad", &p.delta_h_T_limit}},
               {});
}

void read_gains(const YamlNode& node, controllers::HoppingLegGains& gains) {
  read_entries(node,
               {{"kp_LA", "N m/rad", &gains.kp_LA},
                {"kd_LA", "N m s/rad", &gains.kd_LA},
                {"kp_mLS", "N m/rad", &gains.kp_mLS},
                {"kd_mLS", "N m s/rad", &gains.kd_mLS}},
               {});
}

/// A whole number that an int can hold; what else it must be is the controller's to say.
int read_count(const YamlNode& node) {
  constexpr double kMost = 1e6;
  const double count = read_number(node, "1");
  if (!(std::abs(count) <= kMost) || count != std::floor(count)) {
    node.refuse(number_text(count), "a whole number of at most 1000000");
  }
  return static_cast<int>(count);
}

void read_filter(const YamlNode& node, controllers::RateFilterOptions& filter) {
  read_entries(node, {{"time_constant", "s", &filter.time_constant}}, {"samples", "order"});
  filter.samples = read_count(node.at("samples"));
  filter.order = read_count(node.at("order"));
}

void read_supplements(const YamlNode& node, controllers::HoppingSupplements& s) {
  read_entries(node,
               {{"touchdown_time_min", "s", &s.touchdown_time_min},
                {"bounce_time", "s", &s.bounce_time},
                {"kickoff_time_max", "s", &s.kickoff_time_max},
                {"liftoff_time_max", "s", &s.liftoff_time_max}},
               {"contact_samples"});
  s.contact_samples = read_count(node.at("contact_samples"));
}

void read_workspace(const YamlNode& node, controllers::HoppingWorkspace& w) {
  read_entries(node,
               {{"leg_angle_from", "rad", &w.leg_angle_from},
                {"leg_angle_to", "rad", &w.leg_angle_to},
                {"leg_shape_from", "rad", &w.leg_shape_from},
                {"leg_shape_to", "rad", &w.leg_shape_to}},
               {});
}

controllers::LegAngleSource read_leg_angle(const YamlNode& node) {
  const std::string text = node.text();
  if (text != "joints" && text != "motor") {
    node.refuse("joints or motor");
  }
  return text == "motor" ? controllers::LegAngleSource::motor : controllers::LegAngleSource::joints;
}

}  // namespace

HoppingConfig read_hopping(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  HoppingConfig config;
  if (root.at("plumbline").text() != "controller/1") {
    root.at("plumbline").refuse("`plumbline: controller/1`");
  }
  if (root.at("controller").text() != "hopping") {
    root.at("controller").refuse("hopping");
  }
  read_entries(
      root,
      {{"period", "s", &config.period},
       {"boom_length", "m", &config.boom_length},
       {"torque_limit_mLA", "N m", &config.torque_limit_mLA},
       {"torque_limit_mLS", "N m", &config.torque_limit_mLS}},
      {"plumbline", "controller", "title", "note", "parameters", "event_update", "left", "right", "leg_angle",
       "leg_angle_rate", "leg_angle_filter", "leg_shape_filter", "hip_filter", "supplements", "workspace"});
  read_parameters(root.at("parameters"), config.parameters);
  if (const auto update = root.find("event_update")) {
    read_update(*update, config.parameters);
  }
  read_gains(root.at("left"), config.left);
  read_gains(root.at("right"), config.right);
  config.leg_angle = read_leg_angle(root.at("leg_angle"));
  config.leg_angle_rate = read_leg_angle(root.at("leg_angle_rate"));
  read_filter(root.at("leg_angle_filter"), config.leg_angle_filter);
  read_filter(root.at("leg_shape_filter"), config.leg_shape_filter);
  read_filter(root.at("hip_filter"), config.hip_filter);
  read_supplements(root.at("supplements"), config.supplements);
  if (const auto workspace = root.find("workspace")) {
    read_workspace(*workspace, config.workspace);
  }
  return config;
}

}  // namespace plumbline::validation
