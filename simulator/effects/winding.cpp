#include "simulator/effects/winding.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kTimeConstant, kSlope };

}  // namespace

const Declaration& Winding::declaration() const {
  static const Declaration kDeclaration{
      "winding",
      "a winding under a voltage: its inductance delays the torque, and the back EMF with it",
      "f = delivered - load; delivered_rate = (load - slope*v - delivered)/time_constant",
      "Fitzgerald, Kingsley and Umans, Electric Machinery, 6th edition, 2003, chapter 11 (armature-"
      "controlled motor)",
      {Place::motor},
      {non_negative("time_constant", "s", "inductance over resistance, L/R"),
       non_negative("slope", "{force} s/{position}", "torque lost per speed to the back EMF, K^2/R")},
      {"delivered"},
      "Negative while the delayed torque is more than what is asked for: the field of the winding and the "
      "supply give it."};
  return kDeclaration;
}

Values Winding::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position / s.velocity, s.force / s.velocity};
}

// A short one delays in proportion to its length, so that from next to none a straight line leads to it;
// longer ones need starts of their own.
std::vector<Values> Winding::starts(const Scales& scales) const {
  constexpr double kWeak = 0.03;  // of the usual torque at the usual speed
  const Scales s = guarded(scales);
  const double slope = kWeak * s.force / s.velocity;
  return {{0.1 * s.period, slope}, {0.5 * s.period, slope}, {3.0 * s.period, slope}};
}

bool Winding::is_null(const double* p) const { return p[kTimeConstant] == 0.0; }

double Winding::force(const Motion& m, const double* state, const double* p) const {
  return is_null(p) ? 0.0 : state[0] - m.load;
}

void Winding::state_rate(const Motion& m, const double* state, const double* p, double* rate) const {
  rate[0] = is_null(p) ? 0.0 : (m.load - p[kSlope] * m.velocity - state[0]) / p[kTimeConstant];
}

}  // namespace plumbline::effects
