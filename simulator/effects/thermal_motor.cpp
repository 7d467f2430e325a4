#include "simulator/effects/thermal_motor.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t {
  kMagnetSag,
  kCopperSag,
  kHeating,
  kWindingTime,
  kHousingTime,
  kShare,
  kCopper,
  kAmbient
};
enum State : std::size_t { kWinding, kHousing };

constexpr double kOfCopper = 3.9e-3;  // 1/K
constexpr double kRoom = 293.15;      // K

Parameter sag(const std::string& name, const std::string& meaning) {
  return {name, "1/K", meaning, 0.0, 0.0, 0.1, Scale::linear, false};
}

}  // namespace

const Declaration& ThermalMotor::declaration() const {
  static const Declaration kDeclaration{
      "thermal_motor",
      "a motor that weakens as it warms: copper and housing as two thermal masses",
      "torque = u*(1 - magnet_sag*(housing_temperature - ambient))/(1 + copper_sag*(winding_temperature - "
      "ambient)); winding_temperature_rate = heating*u^2*(1 + copper*(winding_temperature - ambient)) - "
      "(winding_temperature - housing_temperature)/winding_time; housing_temperature_rate = "
      "share*(winding_temperature - housing_temperature)/winding_time - (housing_temperature - "
      "ambient)/housing_time",
      "Hughes and Drury, Electric Motors and Drives, 4th edition, 2013, section 11.2 (heating); Wallscheid "
      "and "
      "Boecker, IEEE Trans. Industry Applications 52(2), 2016 (networks of thermal masses)",
      {Place::motor},
      {sag("magnet_sag", "loss of the torque constant per warming of the magnets"),
       sag("copper_sag", "loss of current per warming of the winding, where an amplifier sets the voltage"),
       fixed("heating", "K/(s ({force})^2)", "warming of the winding per square of torque", 1.0,
             kSmallestPositive, kInfinity),
       fixed("winding_time", "s", "in which the winding gives its heat to the housing", 30.0, 1e-3,
             kInfinity),
       fixed("housing_time", "s", "in which the housing gives its heat to the surroundings", 1000.0, 1e-3,
             kInfinity),
       fixed("share", "1", "heat capacity of the winding over that of the housing", 0.1, 0.0, kInfinity),
       fixed("copper", "1/K", "rise of the winding's resistance", kOfCopper, 0.0, 0.1),
       fixed("ambient", "K", "temperature of the surroundings and of the cold motor", kRoom, 0.0, kInfinity)},
      {"winding_temperature", "housing_temperature"},
      ""};
  return kDeclaration;
}

Values ThermalMotor::typical(const Scales& /*scales*/) const {
  return {kOfCopper, kOfCopper, 1.0, 30.0, 1000.0, 0.1, kOfCopper, kRoom};
}

// The torque's root mean square warms the winding by half a kelvin each second: a small motor near its limit.
// How fast motors warm is on their data sheets; a search finds how much they lose.
std::vector<Values> ThermalMotor::starts(const Scales& scales) const {
  constexpr double kWarming = 0.5;
  const double force = guarded(scales).force;
  Values p = null_values();
  p[kCopperSag] = 1e-4;
  p[kHeating] = kWarming / (force * force);
  return {p};
}

double ThermalMotor::torque(double commanded, const double* state, const double* p) const {
  if (is_null(p)) return commanded;
  return commanded * (1.0 - p[kMagnetSag] * (state[kHousing] - p[kAmbient])) /
         (1.0 + p[kCopperSag] * (state[kWinding] - p[kAmbient]));
}

void ThermalMotor::state_rate(double commanded, const double* state, const double* p, double* rate) const {
  const double loss =
      p[kHeating] * commanded * commanded * (1.0 + p[kCopper] * (state[kWinding] - p[kAmbient]));
  const double flow = (state[kWinding] - state[kHousing]) / p[kWindingTime];
  rate[kWinding] = loss - flow;
  rate[kHousing] = p[kShare] * flow - (state[kHousing] - p[kAmbient]) / p[kHousingTime];
}

void ThermalMotor::settle(double /*commanded*/, const double* p, double* state) const {
  state[kWinding] = state[kHousing] = p[kAmbient];
}

}  // namespace plumbline::effects
