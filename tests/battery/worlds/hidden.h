// Physical effects as a foreign world plays them: written from the textbooks' equations, sharing nothing with
// the laws of the program that is tested.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace plumbline::battery::worlds {

/// An effect at a place with its numbers in SI units. What is not named is 0.
struct Hidden {
  std::string effect, at;
  std::map<std::string, double> values;
  double operator[](std::string_view name) const;
};

/// Reads "coulomb@mLA:level=0.01,smoothing_speed=0.03". Throws std::invalid_argument.
Hidden hidden_from(const std::string& text);

/// Motion of a place. `load`: force that a motor's gear passes on, either sign; 0 elsewhere.
struct PlaceMotion {
  double x = 0.0, v = 0.0, load = 0.0;
};

/// Is it a force of its place that follows from motion and load alone?
bool is_force(const Hidden& effect);
/// How many states of its own does it need (bristles, a mass on a spring)?
int states_of(const Hidden& effect);
using Law = double (*)(const Hidden& effect, const PlaceMotion& m);
/// The force of an effect that follows from motion and load alone; nullptr for others.
Law law_of(const Hidden& effect);
/// Force on the place; `states`: states_of() of them. The sign of a velocity is tanh(v/s), with s a third of
/// the effect's smoothing_speed.
double force(const Hidden& effect, const PlaceMotion& m, const double* states);
void state_rates(const Hidden& effect, const PlaceMotion& m, const double* states, double* rates);

bool is_of_drive(const Hidden& effect);
/// Of a motor's winding, iron and slots (voltage_limit, torque_saturation, torque_ripple, weakening_ends):
/// the torque that comes of what the amplifier is asked for at angle x and speed v.
double delivered(const Hidden& effect, double asked, double x, double v);
/// Rate of the torque of a winding with an inductance.
double current_rate(const Hidden& winding, double asked, double current, double v);
/// What is left of its voltage, as a share, under the motors that are asked for so much at these speeds.
double battery_voltage(const Hidden& battery, const std::vector<double>& asked,
                       const std::vector<double>& speeds);

/// Force on the motor's side of a gear that gives: x and v of its wind-up, motor less ratio times output.
bool is_compliance(const Hidden& effect);
double compliance_force(const Hidden& effect, double x, double v);

/// Names of the effects that these worlds can play.
bool is_known(const std::string& effect);

}  // namespace plumbline::battery::worlds
