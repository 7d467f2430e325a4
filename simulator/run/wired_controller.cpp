#include "simulator/run/wired_controller.h"

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"
#include "simulator/trace/units.h"

namespace plumbline::run {
namespace {

using Wire = InputWire;

int foot_index(const model::Model& model, const std::string& name) {
  for (std::size_t f = 0; f < model.feet.size(); ++f) {
    if (model.feet[f].name == name) {
      return static_cast<int>(f);
    }
  }
  return -1;
}

int switch_index(const model::Model& model, const std::string& name) {
  for (std::size_t k = 0; k < model.switches.size(); ++k) {
    if (model.switches[k].name == name) {
      return static_cast<int>(k);
    }
  }
  return -1;
}

/// The first of the wires that the model has; a named one is a sensor or a switch from then on.
const Wire* first_that_exists(const model::Model& model, const std::vector<Wire>& wires, Wire& resolved) {
  for (const Wire& wire : wires) {
    resolved = wire;
    const bool sensor = model.sensor_index(wire.name) >= 0;
    const bool contact = switch_index(model, wire.name) >= 0;
    if (wire.kind == Wire::Kind::named && (sensor || contact)) {
      resolved.kind = sensor ? Wire::Kind::sensor : Wire::Kind::contact_switch;
      return &wire;
    }
    if (wire.kind == Wire::Kind::fixed || (wire.kind == Wire::Kind::sensor && sensor) ||
        (wire.kind == Wire::Kind::contact_switch && contact) ||
        (wire.kind == Wire::Kind::foot && foot_index(model, wire.name) >= 0)) {
      return &wire;
    }
  }
  return nullptr;
}

std::vector<std::string> known_sources(const model::Model& model) {
  std::vector<std::string> names = model.places(effects::Place::sensor);
  for (const model::ContactSwitch& one : model.switches) {
    names.push_back(one.name);
  }
  return names;
}

int index_in(const std::vector<plumbline_port>& ports, const std::string& name) {
  for (std::size_t i = 0; i < ports.size(); ++i) {
    if (ports[i].name == name) {
      return static_cast<int>(i);
    }
  }
  return -1;
}

void require_unit(const Place_in_file& where, const std::string& unit, const plumbline_port& port) {
  if (!units_agree(unit, port.unit)) {
    throw InputError(
        where, "a signal in " + unit,
        std::string("one in ") + port.unit + ", which input " + port.name + " of the controller has");
  }
}

std::vector<int> motors_of(const model::Model& model, const ControllerSetup& setup) {
  std::vector<int> motors;
  const std::vector<plumbline_port> ports = setup.library.outputs();
  for (std::size_t o = 0; o < ports.size(); ++o) {
    const std::string& name = setup.outputs[o];
    const int motor = model.motor_index(name);
    const Place_in_file where{setup.file, 0, std::string("outputs: ") + ports[o].name};
    if (motor < 0) {
      throw InputError(where, "\"" + name + "\"",
                       "a motor of " + model.file + nearest_names(name, model::motor_names(model)));
    }
    const std::string& unit = model.motors[static_cast<std::size_t>(motor)].command_unit;
    if (!units_agree(unit, ports[o].unit)) {
      throw InputError(where, "a motor commanded in " + unit,
                       std::string("one commanded in ") + ports[o].unit);
    }
    for (const int other : motors) {
      if (other == motor) {
        throw InputError(where, "motor \"" + name + "\" a second time", "each motor once");
      }
    }
    motors.push_back(motor);
  }
  return motors;
}

}  // namespace

WiredController::Source WiredController::find_source(const model::Model& model, const ControllerSetup& setup,
                                                     std::size_t port_index, double& scale) const {
  const plumbline_port port = setup.library.inputs()[port_index];
  const std::vector<Wire>& wires = setup.inputs[port_index];
  const Place_in_file where{setup.file, 0, std::string("inputs: ") + port.name};
  Wire wire;
  scale = 1.0;
  if (first_that_exists(model, wires, wire) == nullptr) {
    throw InputError(where, "\"" + wires.front().name + "\"",
                     "a sensor, switch or foot of " + model.file +
                         nearest_names(wires.front().name, known_sources(model)));
  }
  if (wire.kind == Wire::Kind::fixed) {
    return {Source::Kind::fixed, 0, wire.value};
  }
  if (wire.kind != Wire::Kind::sensor) {
    if (port.kind != PLUMBLINE_SWITCH) {
      throw InputError(where, "the contact \"" + wire.name + "\"", "a sensor: the input is no switch");
    }
    const bool foot = wire.kind == Wire::Kind::foot;
    return {foot ? Source::Kind::foot : Source::Kind::contact_switch,
            foot ? foot_index(model, wire.name) : switch_index(model, wire.name), 1.0};
  }
  const int index = model.sensor_index(wire.name);
  const model::Sensor& sensor = model.sensors[static_cast<std::size_t>(index)];
  if (port.kind == PLUMBLINE_SWITCH) {
    throw InputError(where, "the sensor \"" + wire.name + "\"", "a contact switch or a foot");
  }
  require_unit(where, "(" + model::reading_unit(model, wire.name) + ")/(" + wire.divide_unit + ")", port);
  if (port.kind == PLUMBLINE_VALUE) {
    return {Source::Kind::reading, index, wire.divide_by};
  }
  if (!(sensor.resolution > 0.0)) {
    throw InputError(where, "\"" + wire.name + "\", a sensor without resolution", "one that counts");
  }
  scale = sensor.resolution / wire.divide_by;
  return {Source::Kind::count, index, 1.0};
}

controllers::ControllerInstance WiredController::make(const ControllerSetup& setup,
                                                      const std::vector<double>& scales) {
  try {
    return {setup.library, setup.period, setup.constants, scales};
  } catch (const controllers::ControllerError& error) {
    throw InputError(setup.file + ": " + error.what());
  }
}

WiredController::WiredController(const model::Model& model, const ControllerSetup& setup)
    : period_(setup.period),
      scales_([&] {
        std::vector<double> scales;
        for (std::size_t i = 0; i < setup.inputs.size(); ++i) {
          double scale = 1.0;
          sources_.push_back(find_source(model, setup, i, scale));
          scales.push_back(scale);
        }
        return scales;
      }()),
      motors_(motors_of(model, setup)),
      instance_(make(setup, scales_)),
      inputs_(setup.inputs.size()),
      outputs_(setup.outputs.size()),
      log_(setup.library.log().size()) {}

void WiredController::reset() {
  instance_.reset();
  fault_ = 0;
}

int WiredController::step(const Sensed& sensed, double* command) {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    const Source& source = sources_[i];
    switch (source.kind) {
      case Source::Kind::count:
        inputs_[i] = sensed.counts[source.index];
        break;
      case Source::Kind::reading:
        inputs_[i] = sensed.readings[source.index] / source.factor;
        break;
      case Source::Kind::contact_switch:
        inputs_[i] = sensed.switches[source.index];
        break;
      case Source::Kind::foot:
        inputs_[i] = sensed.feet[source.index];
        break;
      case Source::Kind::fixed:
        inputs_[i] = source.factor;
        break;
    }
  }
  fault_ = instance_.step(inputs_.data(), outputs_.data(), log_.data());
  for (std::size_t o = 0; o < outputs_.size(); ++o) {
    command[motors_[o]] = outputs_[o];
  }
  return fault_;
}

int WiredController::log_index(const std::string& name) const { return index_in(library().log(), name); }
int WiredController::memory_index(const std::string& name) const {
  return index_in(library().memory(), name);
}

}  // namespace plumbline::run
