#include "validation/studies/aslip/aslip_file.h"

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::validation {
namespace {

using model::YamlNode;

struct Entry {
  const char* key;
  const char* unit;
  double* value;
};

void read_section(const YamlNode& root, const char* name, const std::vector<Entry>& entries) {
  const YamlNode section = root.at(name);
  std::vector<std::string> keys;
  for (const Entry& entry : entries) {
    keys.emplace_back(entry.key);
  }
  section.allow_keys(keys);
  for (const Entry& entry : entries) {
    *entry.value = model::read_quantity(section.at(entry.key),
                                        {entry.unit, model::QuantityRule::Sign::positive, false, {}})
                       .value;
  }
}

}  // namespace

AslipFile read_aslip(const std::string& path) {
  const YamlNode root = YamlNode::load(path);
  model::check_format(root, "aslip/1");
  root.allow_keys({"plumbline", "title", "model", "readings", "gains"});
  root.at("title").text();
  AslipFile file;
  AslipModel& m = file.model;
  read_section(root, "model",
               {{"mass", "kg", &m.mass},
                {"inertia", "kg m^2", &m.inertia},
                {"hip_to_com", "m", &m.hip_to_com},
                {"leg_length", "m", &m.leg_length},
                {"spring_rest", "m", &m.spring_rest},
                {"spring_stiffness", "N/m", &m.spring_stiffness},
                {"gravity", "m/s^2", &m.gravity}});
  AslipReadings& r = file.readings;
  read_section(root, "readings",
               {{"pitch", "rad", &r.pitch},
                {"speed", "m/s", &r.speed},
                {"flight", "s", &r.flight},
                {"half_travel", "m", &r.half_travel},
                {"touchdown_force", "N", &r.touchdown_force}});
  SlipEmbedding& g = file.gains;
  read_section(root, "gains",
               {{"pitch", "1/s^2", &g.pitch_gain},
                {"pitch_rate", "1/s", &g.pitch_rate_gain},
                {"epsilon", "1", &g.epsilon},
                {"energy", "1/m", &g.energy_gain},
                {"speed", "rad s/m", &g.speed_gain}});
  return file;
}

}  // namespace plumbline::validation
