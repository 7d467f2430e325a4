#include "validation/report/model_json.h"

#include "simulator/model/kinds.h"
#include "validation/report/json_number.h"

namespace plumbline::validation {
namespace {

using model::Model;
using model::Quantity;
using nlohmann::json;

json to_json(const Quantity& quantity, const std::string& unit) {
  return {{"value", json_number(quantity.value)},
          {"standard_deviation", quantity.uncertainty},
          {"unit", unit},
          {"source", quantity.source},
          {"assumed", quantity.assumed}};
}

json terms_json(const std::vector<model::Term>& terms) {
  json factors = json::object();
  for (const model::Term& term : terms) {
    factors[term.of] = term.factor;
  }
  return factors;
}

json effects_json(const Model& model) {
  json list = json::array();
  for (const model::EffectUse& use : model.effects) {
    json values = json::object();
    for (std::size_t p = 0; p < use.values.size(); ++p) {
      values[use.law->declaration().parameters[p].name] = to_json(use.values[p], unit_of(model, use, p));
    }
    list.push_back({{"effect", use.law->declaration().name}, {"at", use.at}, {"values", values}});
  }
  return list;
}

json bodies_json(const Model& model) {
  json list = json::array();
  for (const model::Body& body : model.skeleton.bodies) {
    list.push_back({{"name", body.name}, {"mass", body.mass}, {"standard_deviation", body.mass_uncertainty}});
  }
  return list;
}

json coordinates_json(const Model& model) {
  json list = json::array();
  for (const model::Coordinate& coordinate : model.coordinates) {
    list.push_back({{"name", coordinate.name},
                    {"unit", model::position_unit(coordinate.angular)},
                    {"of", terms_json(coordinate.terms)}});
  }
  return list;
}

json motors_json(const Model& model) {
  json list = json::array();
  for (const model::Motor& motor : model.motors) {
    const std::string force = model::force_unit(motor.angular);
    const bool limited = motor.torque_limit.value > 0.0;
    list.push_back(
        {{"name", motor.name},
         {"command_unit", motor.command_unit},
         {"rotor_inertia", to_json(motor.rotor_inertia, model::inertia_unit(motor.angular))},
         {"torque_constant", to_json(motor.torque_constant, force + "/(" + motor.command_unit + ")")},
         {"torque_limit", limited ? to_json(motor.torque_limit, force) : json()}});
  }
  return list;
}

json pulleys_json(const Model& model) {
  json list = json::array();
  for (const model::Pulley& pulley : model.pulleys) {
    list.push_back({{"name", pulley.name}, {"inertia", to_json(pulley.inertia, model::inertia_unit(true))}});
  }
  return list;
}

json ratios_json(const Model& model) {
  json list = json::array();
  for (const model::Ratio& ratio : model.ratios) {
    list.push_back({{"name", ratio.name}, {"of", ratio.motor}, {"to", terms_json(ratio.to)}});
  }
  return list;
}

json inertias_json(const Model& model) {
  json list = json::array();
  for (const model::Inertia& inertia : model.inertias) {
    const std::string unit = model::inertia_unit(model::is_angular(model, inertia.at));
    list.push_back({{"name", inertia.name}, {"at", inertia.at}, {"value", to_json(inertia.value, unit)}});
  }
  return list;
}

json sensors_json(const Model& model) {
  json list = json::array();
  for (const model::Sensor& sensor : model.sensors) {
    list.push_back({{"name", sensor.name},
                    {"measures", sensor.is_at_point() ? measured_by(model, sensor) : sensor.measures},
                    {"unit", model::reading_unit(model, sensor.name)},
                    {"resolution", sensor.resolution},
                    {"noise", sensor.noise},
                    {"floor", sensor.floor()}});
  }
  return list;
}

json contacts_json(const Model& model) {
  json list = json::array();
  for (const model::LinkContact& contact : model.contacts) {
    json one{{"name", contact.name}, {"between", json::array()}, {"shapes", json::array()}};
    for (const model::ContactEnd& end : contact.ends) {
      one["between"].push_back(end.body < 0 ? "world"
                                            : model.skeleton.bodies[static_cast<std::size_t>(end.body)].name);
      one["shapes"].push_back(contact::name_of(end.shape));
    }
    list.push_back(std::move(one));
  }
  return list;
}

/// A link's name, or "world".
json loops_json(const Model& model) {
  json list = json::array();
  for (const model::Loop& loop : model.loops) {
    json one{{"name", loop.name}, {"type", to_string(loop.type)}, {"between", json::array()}};
    for (const model::LoopEnd& end : loop.ends) {
      one["between"].push_back(end.body < 0 ? "world"
                                            : model.skeleton.bodies[static_cast<std::size_t>(end.body)].name);
    }
    list.push_back(one);
  }
  return list;
}

json switches_json(const Model& model) {
  json list = json::array();
  for (const model::ContactSwitch& one : model.switches) {
    list.push_back({{"name", one.name}, {"foot", model.feet[static_cast<std::size_t>(one.foot)].name}});
  }
  return list;
}

}  // namespace

std::string unit_of(const model::Model& model, const model::EffectUse& use, std::size_t parameter) {
  const bool angular = model.place_is_angular(model.resolve(*use.law, use.at), use.at);
  return effects::unit_at(use.law->declaration().parameters[parameter].unit, angular);
}

const std::vector<effects::Place>& all_places() {
  static const std::vector<effects::Place> kPlaces{
      effects::Place::coordinate,     effects::Place::motor, effects::Place::ratio, effects::Place::body,
      effects::Place::sensor,         effects::Place::world, effects::Place::foot,  effects::Place::base,
      effects::Place::contact_switch, effects::Place::limb};
  return kPlaces;
}

nlohmann::json model_json(const model::Model& model) {
  json places = json::object();
  for (const effects::Place place : all_places()) {
    places[effects::to_string(place)] = model.places(place);
  }
  return {{"kind", "model"},
          {"file", model.file},
          {"robot", model.robot},
          {"lineage", model.lineage},
          {"skeleton", model.skeleton.file},
          {"bodies", bodies_json(model)},
          {"coordinates", coordinates_json(model)},
          {"motors", motors_json(model)},
          {"pulleys", pulleys_json(model)},
          {"ratios", ratios_json(model)},
          {"inertias", inertias_json(model)},
          {"loops", loops_json(model)},
          {"contacts", contacts_json(model)},
          {"effects", effects_json(model)},
          {"sensors", sensors_json(model)},
          {"contact_switches", switches_json(model)},
          {"places", places}};
}

}  // namespace plumbline::validation
