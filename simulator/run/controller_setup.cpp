#include "simulator/run/controller_setup.h"

#include <optional>
#include <utility>

#include "simulator/model/quantity.h"
#include "simulator/model/yaml_chain.h"
#include "simulator/model/yaml_node.h"
#include "simulator/trace/table.h"
#include "simulator/trace/units.h"

namespace plumbline::run {
namespace {

using model::YamlNode;

constexpr const char* kControllerFormat = "controller/2";

YamlNode newest(const std::vector<YamlNode>& chain, const std::string& key) {
  const auto found = model::find_newest(chain, key);
  return found ? *found : chain.back().at(key);  // whose message says what is missing, and where
}

/// One section's entries of all documents, the newest of each name.
std::map<std::string, YamlNode> merged(const std::vector<YamlNode>& chain, const std::string& key) {
  std::map<std::string, YamlNode> all;
  for (const YamlNode& document : chain) {
    if (const auto section = document.find(key)) {
      for (const auto& [name, node] : section->entries()) {
        all.emplace(name, node);
      }
    }
  }
  return all;
}

std::vector<std::string> names_of(const std::vector<plumbline_port>& ports) {
  std::vector<std::string> names;
  for (const plumbline_port& port : ports) {
    names.emplace_back(port.name);
  }
  return names;
}

/// The entry of each port, in order. Refuses what is missing and what the controller does not have.
std::vector<YamlNode> in_order(const std::vector<YamlNode>& chain, const std::string& key,
                               const std::vector<plumbline_port>& ports, const std::string& controller) {
  const std::map<std::string, YamlNode> stated = merged(chain, key);
  const std::vector<std::string> names = names_of(ports);
  for (const auto& [name, node] : stated) {
    bool known = false;
    for (const std::string& one : names) {
      known = known || one == name;
    }
    if (!known) {
      throw InputError(node.place(), "no such port of controller " + controller,
                       "one of its " + key + nearest_names(name, names));
    }
  }
  std::vector<YamlNode> ordered;
  for (const std::string& name : names) {
    const auto found = stated.find(name);
    if (found == stated.end()) {
      throw InputError({chain.front().file(), 0, key}, "no \"" + name + "\"",
                       "it, which controller " + controller + " needs");
    }
    ordered.push_back(found->second);
  }
  return ordered;
}

InputWire read_wire(const YamlNode& node, const plumbline_port& port) {
  InputWire wire;
  if (!node.is_map()) {
    wire.name = node.text();
    return wire;
  }
  if (node.has("value")) {
    if (port.kind == PLUMBLINE_COUNT) {
      node.refuse("a fixed value", "a sensor: the port takes counts");
    }
    wire.kind = InputWire::Kind::fixed;
    wire.value = model::read_quantity(node, {port.unit, model::QuantityRule::Sign::any, false, {}}).value;
    return wire;
  }
  node.allow_keys({"sensor", "divide_by", "switch", "foot"});
  const auto sensor = node.find("sensor");
  const auto contact = node.find("switch");
  const auto foot = node.find("foot");
  if ((sensor ? 1 : 0) + (contact ? 1 : 0) + (foot ? 1 : 0) != 1) {
    node.refuse("a map with one of sensor, switch and foot, or {value: ..., unit: ..., source: ...}");
  }
  wire.kind = sensor    ? InputWire::Kind::sensor
              : contact ? InputWire::Kind::contact_switch
                        : InputWire::Kind::foot;
  wire.name = (sensor ? *sensor : contact ? *contact : *foot).text();
  if (const auto divide = node.find("divide_by")) {
    if (!sensor) {
      divide->refuse("a sensor to divide");
    }
    const YamlNode unit = divide->at("unit");
    if (!unit_is_known(unit.text())) {
      unit.refuse("a unit");
    }
    wire.divide_unit = unit.text();
    wire.divide_by =
        model::read_quantity(*divide, {unit.text(), model::QuantityRule::Sign::not_zero, false, {}}).value;
  }
  return wire;
}

std::vector<InputWire> read_wires(const YamlNode& node, const plumbline_port& port) {
  if (!node.is_map() || !node.has("first_of")) {
    return {read_wire(node, port)};
  }
  node.allow_keys({"first_of"});
  std::vector<InputWire> wires;
  for (const YamlNode& item : node.at("first_of").items()) {
    wires.push_back(read_wire(item, port));
  }
  if (wires.empty()) {
    node.refuse("an empty list", "a sensor");
  }
  return wires;
}

controllers::LoadedController load(const YamlNode& node) {
  const std::string name = node.text();
  const bool is_path = name.find('/') != std::string::npos || name.find('.') != std::string::npos;
  const std::string path = is_path ? model::beside(node.file(), name) : controllers::find_controller(name);
  if (path.empty()) {
    node.refuse(
        model::quote(name) + ", which is not among the built controllers",
        "the name of a library in build/controllers (or in a folder of PLUMBLINE_CONTROLLERS), or a path "
        "such as ./" +
            name + ".so");
  }
  try {
    return controllers::LoadedController(path);
  } catch (const controllers::ControllerError& error) {
    throw InputError(node.file() + ":" + std::to_string(node.line()) + ": library: " + error.what());
  }
}

double read_constant(const YamlNode& node, const plumbline_port& port, model::Quantity& quantity) {
  quantity = model::read_quantity(node, {port.unit, model::QuantityRule::Sign::any, true, {}});
  if (!(quantity.value >= port.lower && quantity.value <= port.upper)) {
    node.at("value").refuse("a number from " + std::to_string(port.lower) + " to " +
                            std::to_string(port.upper) + " " + port.unit);
  }
  return quantity.value;
}

}  // namespace

std::size_t ControllerSetup::constant_index(const std::string& name) const {
  const std::vector<std::string> names = names_of(library.constants());
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c] == name) {
      return c;
    }
  }
  throw InputError({file, 0, "constants"}, "no constant \"" + name + "\" of controller " + library.api().name,
                   "one of its constants" + nearest_names(name, names));
}

ControllerSetup read_controller(const std::string& path) {
  const std::vector<YamlNode> chain = model::read_chain(path, kControllerFormat);
  for (const YamlNode& document : chain) {
    document.allow_keys(
        {"plumbline", "base", "library", "title", "note", "period", "constants", "inputs", "outputs"});
  }
  ControllerSetup setup{path, "", load(newest(chain, "library")), 0.0, {}, {}, {}, {}, {path, 0, "inputs"}};
  const auto title = model::find_newest(chain, "title");
  setup.title = title ? title->text() : setup.library.api().name;
  setup.period =
      model::read_quantity(newest(chain, "period"), {"s", model::QuantityRule::Sign::positive, false, {}})
          .value;
  const std::string name = setup.library.api().name;
  const auto constants = setup.library.constants();
  const std::vector<YamlNode> values = in_order(chain, "constants", constants, name);
  for (std::size_t c = 0; c < constants.size(); ++c) {
    model::Quantity quantity;
    setup.constants.push_back(read_constant(values[c], constants[c], quantity));
    setup.quantities.push_back(quantity);
  }
  const auto inputs = setup.library.inputs();
  const std::vector<YamlNode> wires = in_order(chain, "inputs", inputs, name);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    setup.inputs.push_back(read_wires(wires[i], inputs[i]));
  }
  for (const YamlNode& node : in_order(chain, "outputs", setup.library.outputs(), name)) {
    setup.outputs.push_back(node.text());
  }
  return setup;
}

void write_constants(const std::string& path, const std::string& base_file, const ControllerSetup& setup,
                     const std::vector<std::string>& names, const std::string& note,
                     const std::string& origin) {
  YAML::Emitter out;
  model::begin_overlay(out, path, kControllerFormat, base_file, note);
  out << YAML::Key << "constants" << YAML::Value << YAML::BeginMap;
  const auto ports = setup.library.constants();
  for (const std::string& name : names) {
    const std::size_t c = setup.constant_index(name);
    model::emit_quantity(out, name, {setup.constants[c], ports[c].unit, 0.0, "assumed", origin});
  }
  out << YAML::EndMap << YAML::EndMap;
  write_text_atomically(path, std::string(out.c_str()) + "\n");
}

}  // namespace plumbline::run
