#include "simulator/effects/voltage_limit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kStallTorque, kNoLoadSpeed };

Parameter limit(const std::string& name, const std::string& unit, const std::string& meaning) {
  return {name, unit, meaning, kInfinity, kSmallestPositive, kInfinity, Scale::reciprocal, false};
}

/// Torque of the back EMF at the bus voltage's limit.
double lost_to_speed(double v, const double* p) { return p[kStallTorque] / p[kNoLoadSpeed] * v; }

}  // namespace

const Declaration& VoltageLimit::declaration() const {
  static const Declaration kDeclaration{
      "voltage_limit",
      "a bus voltage that bounds what the winding can give: torque falls with speed",
      "f = min(max(load, -stall_torque - slope*v), stall_torque - slope*v) - load; slope = "
      "stall_torque/no_load_speed",
      "Fitzgerald, Kingsley and Umans, Electric Machinery, 6th edition, 2003, section 7.4 (speed against "
      "torque of a permanent-magnet machine at constant voltage)",
      {Place::motor},
      {limit("stall_torque", "{force}", "torque at standstill at full voltage, K U/R"),
       limit("no_load_speed", "{position}/s", "speed at which the back EMF takes all of the voltage, U/K")},
      {},
      "Negative while the motor brakes harder than the voltage lets it: what the commanded torque would have "
      "taken out of the motion stays in it."};
  return kDeclaration;
}

Values VoltageLimit::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {2.0 * s.force, 4.0 * s.velocity};
}

// A limit that is never reached has no slope, and one that always is explains nothing: a search begins where
// the first samples reach it. Peaks of a motion's torque are at one and a half to four times its root mean
// square.
std::vector<Values> VoltageLimit::starts(const Scales& scales) const {
  const Scales s = guarded(scales);
  std::vector<Values> starts{{1.2 * s.force, 12.0 * s.velocity}, {4.0 * s.force, 2.5 * s.velocity}};
  for (const double stall : {1.6, 2.0, 2.4, 2.8, 3.4}) {
    for (const double no_load : {5.0, 12.0}) {
      starts.push_back({stall * s.force, no_load * s.velocity});
    }
  }
  return starts;
}

bool VoltageLimit::is_null(const double* p) const { return std::isinf(p[kStallTorque]); }

double VoltageLimit::force(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  const double lost = lost_to_speed(m.velocity, p);
  return std::min(std::max(m.load, -p[kStallTorque] - lost), p[kStallTorque] - lost) - m.load;
}

void VoltageLimit::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  const double lost = is_null(p) ? 0.0 : lost_to_speed(m.velocity, p);
  g.push_back(is_null(p) ? 1.0 : p[kStallTorque] - lost - m.load);
  g.push_back(is_null(p) ? 1.0 : p[kStallTorque] + lost + m.load);
}

}  // namespace plumbline::effects
