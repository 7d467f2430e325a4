#include "validation/control/gait/channels.h"

#include <algorithm>

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

bool begins_with(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }

/// Examples for the message: what this scenario has, without every position twice.
std::vector<std::string> known_names(const run::LoadedScenario& loaded) {
  std::vector<std::string> names;
  for (const run::Quantity& quantity : loaded.scenario.quantities) {
    names.push_back(quantity.name);
  }
  if (loaded.controller) {
    for (const plumbline_port& port : loaded.controller->library.log()) {
      names.emplace_back(port.name);
    }
  }
  for (const model::Sensor& sensor : loaded.model.sensors) {
    names.push_back(model::reading_column(sensor));
  }
  for (const model::Motor& motor : loaded.model.motors) {
    names.push_back("u_" + motor.name);
  }
  for (const model::Ratio& ratio : loaded.model.ratios) {
    names.push_back("stretch_" + ratio.name);
  }
  for (const model::Foot& foot : loaded.model.feet) {
    names.push_back("contact_" + foot.name);
  }
  return names;
}

}  // namespace

Channels::Channels(const run::LoadedScenario& loaded, const std::vector<std::string>& names,
                   const Place_in_file& where) {
  for (const std::string& name : names) {
    if (index(name) < 0 && !add(loaded, name)) {
      throw InputError(where, "\"" + name + "\"",
                       "a channel of the run" + nearest_names(name, known_names(loaded)));
    }
  }
}

int Channels::index(const std::string& name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? -1 : static_cast<int>(found - names_.begin());
}

void Channels::read(run::SampledRun& sampled, double* row) const {
  const Eigen::VectorXd state = sampled.simulation().state();
  for (std::size_t c = 0; c < readers_.size(); ++c) {
    row[c] = readers_[c](sampled, state.data());
  }
}

void Channels::push(const std::string& name, const std::string& unit, Reader reader) {
  names_.push_back(name);
  units_.push_back(unit);
  readers_.push_back(std::move(reader));
}

bool Channels::add(const run::LoadedScenario& loaded, const std::string& name) {
  for (const run::Quantity& quantity : loaded.scenario.quantities) {
    if (quantity.name == name) {
      push(name, quantity.unit, [quantity](run::SampledRun& sampled, const double* x) {
        return quantity.value(sampled.plant(), x);
      });
      return true;
    }
  }
  const model::Model& model = loaded.model;
  for (std::size_t s = 0; s < model.sensors.size(); ++s) {
    if (model::reading_column(model.sensors[s]) == name) {
      const auto i = static_cast<Eigen::Index>(s);
      push(name, model::reading_unit(model, model.sensors[s].name),
           [i](run::SampledRun& sampled, const double*) { return sampled.simulation().outputs()[i]; });
      return true;
    }
  }
  if (loaded.controller) {
    const std::vector<plumbline_port> log = loaded.controller->library.log();
    for (std::size_t l = 0; l < log.size(); ++l) {
      if (log[l].name == name) {
        push(name, log[l].unit,
             [l](run::SampledRun& sampled, const double*) { return sampled.controller()->log()[l]; });
        return true;
      }
    }
  }
  return add_motor(model, name) || add_foot(model, name) || add_place(model, name);
}

bool Channels::add_motor(const model::Model& model, const std::string& name) {
  const bool power = begins_with(name, "power_");
  if (!power && !begins_with(name, "u_")) {
    return false;
  }
  const std::string of = name.substr(power ? 6 : 2);
  const int motor = model.motor_index(of);
  if (motor < 0) {
    return false;
  }
  if (!power) {
    push(name, model.motors[static_cast<std::size_t>(motor)].command_unit,
         [motor](run::SampledRun& sampled, const double*) { return sampled.command()[motor]; });
    return true;
  }
  push(name, "W", [motor, of](run::SampledRun& sampled, const double* x) {
    return sampled.plant().torque_gain(motor) * sampled.command()[motor] * sampled.plant().velocity_of(of, x);
  });
  return true;
}

bool Channels::add_foot(const model::Model& model, const std::string& name) {
  for (std::size_t f = 0; f < model.feet.size(); ++f) {
    if (name == "contact_" + model.feet[f].name) {
      push(name, "1", [f](run::SampledRun& sampled, const double*) {
        return sampled.simulation().touches()[f].depth > 0.0 ? 1.0 : 0.0;
      });
      return true;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (name == "F_" + model.feet[f].name + "_" + "xyz"[axis]) {
        push(name, "N", [f, axis](run::SampledRun& sampled, const double*) {
          return sampled.simulation().touches()[f].force[axis];
        });
        return true;
      }
    }
  }
  return false;
}

bool Channels::add_place(const model::Model& model, const std::string& name) {
  if (begins_with(name, "stretch_")) {
    const std::string of = name.substr(8);
    if (model.find_ratio(of) == nullptr && model.find_rod(of) == nullptr) {
      return false;
    }
    push(name, model::position_unit(model.place_is_angular(effects::Place::ratio, of)),
         [of](run::SampledRun& sampled, const double* x) {
           return sampled.plant().motion_at(effects::Place::ratio, of, x).position;
         });
    return true;
  }
  if (!begins_with(name, "x_") && !begins_with(name, "v_")) {
    return false;
  }
  const bool velocity = name[0] == 'v';
  const std::string of = name.substr(2);
  std::vector<std::string> known = model::position_names(model);
  for (const std::string& joint : model::joint_names(model.skeleton)) {
    known.push_back(joint);
  }
  if (std::find(known.begin(), known.end(), of) == known.end()) {
    return false;
  }
  push(name, model::position_unit(model::is_angular(model, of)) + (velocity ? "/s" : ""),
       [of, velocity](run::SampledRun& sampled, const double* x) {
         return velocity ? sampled.plant().velocity_of(of, x) : sampled.plant().position_of(of, x);
       });
  return true;
}

}  // namespace plumbline::validation
