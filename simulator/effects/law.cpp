#include "simulator/effects/law.h"

#include <algorithm>

namespace plumbline::effects {
namespace {

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

}  // namespace

bool Law::is_null(const double* p) const {
  const auto& parameters = declaration().parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].structural && p[i] != parameters[i].null_value) return false;
  }
  return true;
}

Values Law::null_values() const {
  Values values;
  for (const auto& parameter : declaration().parameters) values.push_back(parameter.null_value);
  return values;
}

int Law::parameter_index(const std::string& name) const {
  const auto& parameters = declaration().parameters;
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const Parameter& parameter) { return parameter.name == name; });
  return found == parameters.end() ? -1 : static_cast<int>(found - parameters.begin());
}

bool Law::sits_at(Place place) const {
  const auto& places = declaration().places;
  return std::find(places.begin(), places.end(), place) != places.end();
}

double ForceLaw::stored_energy(const Motion& /*m*/, const double* /*state*/, const double* /*p*/) const {
  return 0.0;
}

double ForceLaw::dissipated_power(const Motion& /*m*/, const double* /*state*/, const double* /*p*/) const {
  return 0.0;
}

void ForceLaw::state_rate(const Motion& /*m*/, const double* /*state*/, const double* /*p*/,
                          double* /*rate*/) const {}

void ForceLaw::switches(const Motion& /*m*/, const double* /*p*/, std::vector<double>& /*g*/) const {}

int ForceLaw::jumps(const double* /*p*/) const { return 0; }

void ActuatorLaw::state_rate(double /*commanded*/, const double* /*state*/, const double* /*p*/,
                             double* /*rate*/) const {}

void ActuatorLaw::settle(double /*commanded*/, const double* /*p*/, double* /*state*/) const {}

double ActuatorLaw::delay(const double* /*p*/) const { return 0.0; }

std::string unit_at(const std::string& general_unit, bool angular) {
  std::string unit = general_unit;
  replace_all(unit, "{force}", angular ? "N m" : "N");
  replace_all(unit, "{position}", angular ? "rad" : "m");
  replace_all(unit, "{inertia}", angular ? "kg m^2" : "kg");
  replace_all(unit, "{inertial}", angular ? "rad/s" : "m/s^2");
  return unit;
}

std::string to_string(Place place) {
  switch (place) {
    case Place::coordinate:
      return "coordinate";
    case Place::motor:
      return "motor";
    case Place::ratio:
      return "ratio";
    case Place::body:
      return "body";
    case Place::sensor:
      return "sensor";
    case Place::world:
      return "world";
    case Place::foot:
      return "foot";
    case Place::base:
      return "base";
    case Place::contact_switch:
      return "contact switch";
    case Place::limb:
      return "limb";
  }
  return "unknown";
}

}  // namespace plumbline::effects
