#include "simulator/model/model.h"

#include <algorithm>
#include <cmath>

#include "contact/ground_turning.h"
#include "simulator/model/inertial_sensors.h"
#include "simulator/model/kinds.h"
#include "simulator/model/limbs.h"
#include "simulator/model/places.h"
#include "simulator/model/planar_base.h"
#include "simulator/trace/error.h"

namespace plumbline::model {
namespace {

template <typename Item>
const Item* find_named(const std::vector<Item>& items, const std::string& name) {
  const auto found =
      std::find_if(items.begin(), items.end(), [&](const Item& item) { return item.name == name; });
  return found == items.end() ? nullptr : &*found;
}

template <typename Item>
int index_of(const std::vector<Item>& items, const std::string& name) {
  const Item* item = find_named(items, name);
  return item == nullptr ? -1 : static_cast<int>(item - items.data());
}

template <typename Item>
void append_names(const std::vector<Item>& items, std::vector<std::string>& names) {
  for (const Item& item : items) {
    names.push_back(item.name);
  }
}

}  // namespace

effects::Values EffectUse::numbers() const {
  effects::Values numbers;
  for (const Quantity& quantity : values) {
    numbers.push_back(quantity.value);
  }
  return numbers;
}

std::string EffectUse::label() const { return law->declaration().name + " at " + at; }

double Sensor::floor() const { return std::sqrt(resolution * resolution / 12.0 + noise * noise); }

const Coordinate* Model::find_coordinate(const std::string& name) const {
  return find_named(coordinates, name);
}
const Motor* Model::find_motor(const std::string& name) const { return find_named(motors, name); }
const Pulley* Model::find_pulley(const std::string& name) const { return find_named(pulleys, name); }
const Sensor* Model::find_sensor(const std::string& name) const { return find_named(sensors, name); }
const Ratio* Model::find_ratio(const std::string& name) const { return find_named(ratios, name); }

const Loop* Model::find_rod(const std::string& name) const {
  const Loop* loop = find_named(loops, name);
  return loop != nullptr && loop->type == Loop::Type::rod ? loop : nullptr;
}

const ContactSwitch* Model::find_switch(const std::string& name) const { return find_named(switches, name); }

int Model::body_index(const std::string& name) const { return index_of(skeleton.bodies, name); }
int Model::motor_index(const std::string& name) const { return index_of(motors, name); }
int Model::sensor_index(const std::string& name) const { return index_of(sensors, name); }

bool Model::has_force_plate() const {
  return std::any_of(sensors.begin(), sensors.end(), [](const Sensor& one) { return one.is_force_plate(); });
}

bool Model::has(PointReading reading) const {
  return std::any_of(sensors.begin(), sensors.end(),
                     [&](const Sensor& one) { return one.reading == reading; });
}

std::vector<std::string> Model::places(effects::Place place) const {
  std::vector<std::string> names;
  switch (place) {
    case effects::Place::coordinate:
      append_names(coordinates, names);
      append_names(pulleys, names);
      break;
    case effects::Place::motor:
      append_names(motors, names);
      break;
    case effects::Place::ratio:
      for (const Ratio& ratio : ratios) {
        if (find_motor(ratio.motor) != nullptr) {  // a joint tied to coordinates is never released
          names.push_back(ratio.name);
        }
      }
      for (const Loop& loop : loops) {
        if (loop.type == Loop::Type::rod) {
          names.push_back(loop.name);
        }
      }
      break;
    case effects::Place::body:
      for (const Body& body : skeleton.bodies) {
        if (!body.is_between) {
          names.push_back(body.name);
        }
      }
      break;
    case effects::Place::sensor:
      for (const Sensor& sensor : sensors) {
        if (sensor.shows_position()) {  // the laws at sensors are those of encoders
          names.push_back(sensor.name);
        }
      }
      break;
    case effects::Place::world:
      names.emplace_back("world");
      break;
    case effects::Place::foot:
      for (const Foot& foot : feet) {
        const std::string& at = foot.group.empty() ? foot.name : foot.group;
        if (std::find(names.begin(), names.end(), at) == names.end()) {
          names.push_back(at);
        }
      }
      append_names(contacts, names);
      break;
    case effects::Place::base:
      if (planar_base(skeleton)) {
        names.emplace_back("base");
      }
      break;
    case effects::Place::contact_switch:
      append_names(switches, names);
      break;
    case effects::Place::limb:
      names = limbs(*this);
      break;
  }
  return names;
}

bool Model::place_is_angular(effects::Place place, const std::string& at) const {
  switch (place) {
    case effects::Place::coordinate:
    case effects::Place::motor:
      return is_angular(*this, at);
    case effects::Place::ratio: {
      // The stretch is motor position minus ratio times coordinate: it has the motor's kind. A rod's is a
      // length.
      const Ratio* ratio = find_ratio(at);
      return ratio == nullptr ? find_rod(at) == nullptr : is_angular(*this, ratio->motor);
    }
    case effects::Place::sensor: {
      const Sensor* inertial = find_inertial(*this, at);
      const Sensor* sensor = inertial != nullptr ? inertial : find_sensor(at);
      if (sensor != nullptr && sensor->is_at_point()) {
        return sensor->reading == PointReading::orientation || sensor->reading == PointReading::gyroscope;
      }
      return sensor == nullptr || is_angular(*this, sensor->measures);
    }
    case effects::Place::foot:
    case effects::Place::base:
    case effects::Place::contact_switch:
      return false;
    case effects::Place::body:
    case effects::Place::world:
    case effects::Place::limb:
      break;
  }
  return true;
}

effects::Place Model::resolve(const effects::Law& law, const std::string& at) const {
  if (const std::optional<effects::Place> place = find_place(*this, law, at)) {
    return *place;
  }
  throw InputError({file, 0, law.declaration().name}, "place \"" + at + "\"", expected_place(*this, law, at));
}

namespace {

bool is_of_inertial(const effects::Law& law, effects::Place place) {
  return place == effects::Place::sensor && dynamic_cast<const effects::InertialSensorLaw*>(&law) != nullptr;
}

bool is_of_feet_alone(const effects::Law& law, effects::Place place) {
  return place == effects::Place::foot && dynamic_cast<const contact::TurningLaw*>(&law) != nullptr;
}

}  // namespace

std::vector<std::string> places_of(const Model& model, const effects::Law& law, effects::Place place) {
  if (is_of_inertial(law, place)) {
    return inertial_sensors(model);
  }
  std::vector<std::string> names = model.places(place);
  if (is_of_feet_alone(law, place)) {
    names.resize(names.size() - model.contacts.size());  // they stand last
  }
  return names;
}

std::optional<effects::Place> find_place(const Model& model, const effects::Law& law, const std::string& at) {
  for (const effects::Place place : law.declaration().places) {
    const std::vector<std::string> names = places_of(model, law, place);
    if (std::find(names.begin(), names.end(), at) != names.end()) {
      return place;
    }
  }
  return std::nullopt;
}

std::string expected_place(const Model& model, const effects::Law& law, const std::string& at) {
  std::string kinds;
  std::vector<std::string> known;
  for (const effects::Place place : law.declaration().places) {
    const std::string kind =
        is_of_inertial(law, place) ? "gyroscope or accelerometer of three axes"
        : place == effects::Place::foot && !model.contacts.empty() && !is_of_feet_alone(law, place)
            ? "foot or contact"
            : effects::to_string(place);
    kinds += (kinds.empty() ? "" : " or ") + kind;
    for (const std::string& name : places_of(model, law, place)) {
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        known.push_back(name);
      }
    }
  }
  return "the name of a " + kinds + nearest_names(at, known);
}

}  // namespace plumbline::model
