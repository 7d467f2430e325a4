#include "simulator/effects/lugre.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kLevel, kRise, kStribeckSpeed, kStiffness, kBristleDamping, kViscous };

bool has_bristles(const double* p) { return p[kLevel] != 0.0 || p[kRise] != 0.0; }

// Friction force of steady sliding, without the viscous part. Kept off zero, which it nears at high speed
// when there is a rise but no level.
double steady_force(double v, const double* p) {
  const double u = v / p[kStribeckSpeed];
  return std::max(p[kLevel] + p[kRise] * std::exp(-u * u), 1e-9 * (p[kLevel] + p[kRise]));
}

double bristle_rate(double v, double z, const double* p) {
  return v - p[kStiffness] * std::abs(v) / steady_force(v, p) * z;
}

}  // namespace

const Declaration& LuGre::declaration() const {
  static const Declaration kDeclaration{
      "lugre",
      "bristles that deflect before the surfaces slide",
      "f = -(stiffness*bristle + bristle_damping*bristle_rate + viscous*v); bristle_rate = v - "
      "stiffness*|v|/g*bristle; g = level + rise*exp(-(v/stribeck_speed)^2)",
      "Canudas de Wit, Olsson, Astrom and Lischinsky, A new model for control of systems with friction, IEEE "
      "Trans. Automatic Control 40(3), 1995; passivity: Barabanov and Ortega, IEEE Trans. Automatic Control "
      "45(4), 2000",
      {Place::coordinate, Place::motor},
      {non_negative("level", "{force}", "friction force at high speed, F_C"),
       non_negative("rise", "{force}", "what friction at low speed exceeds the level by, F_S - F_C"),
       positive("stribeck_speed", "{position}/s", "speed over which the rise fades", 0.1),
       positive("stiffness", "{force}/{position}", "stiffness of the bristles, sigma_0", 1e3),
       non_negative("bristle_damping", "{force} s/{position}", "damping of the bristles, sigma_1"),
       non_negative("viscous", "{force} s/{position}", "viscous friction, sigma_2")},
      {"bristle"},
      "Not negative where viscous*level >= bristle_damping*rise (true when rise = 0) and "
      "|bristle| <= (level + rise)/stiffness, which the state never leaves once inside. Otherwise the "
      "damping of bristles that relax while sliding speeds up can give back more than "
      "friction takes."};
  return kDeclaration;
}

Values LuGre::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force,
          s.force,
          0.1 * s.velocity,
          s.force / (0.1 * s.position),
          s.force / s.velocity,
          s.force / s.velocity};
}

std::vector<Values> LuGre::starts(const Scales& scales) const {
  const Scales s = guarded(scales);
  std::vector<Values> grid;
  for (const double strength : {1e-3, 0.01, 0.1}) {
    for (const double share : {0.05, 0.15, 0.4}) {  // presliding deflection as a share of the motion
      Values p = null_values();
      p[kLevel] = strength * s.force;
      p[kStribeckSpeed] = 0.3 * s.velocity;
      p[kStiffness] = p[kLevel] / (share * s.position);
      p[kBristleDamping] = 0.2 * std::sqrt(p[kStiffness] * s.inertia);  // a tenth of critical damping
      grid.push_back(p);
    }
  }
  return grid;
}

bool LuGre::is_null(const double* p) const { return !has_bristles(p) && p[kViscous] == 0.0; }

double LuGre::force(const Motion& m, const double* state, const double* p) const {
  const double sliding = -p[kViscous] * m.velocity;
  if (!has_bristles(p)) return sliding;
  return sliding - p[kStiffness] * state[0] - p[kBristleDamping] * bristle_rate(m.velocity, state[0], p);
}

double LuGre::stored_energy(const Motion& /*m*/, const double* state, const double* p) const {
  return has_bristles(p) ? 0.5 * p[kStiffness] * state[0] * state[0] : 0.0;
}

double LuGre::dissipated_power(const Motion& m, const double* state, const double* p) const {
  const double v = m.velocity;
  const double sliding = p[kViscous] * v * v;
  if (!has_bristles(p)) return sliding;
  const double rate = bristle_rate(v, state[0], p);
  return sliding + p[kStiffness] * state[0] * (v - rate) + p[kBristleDamping] * rate * v;
}

void LuGre::state_rate(const Motion& m, const double* state, const double* p, double* rate) const {
  rate[0] = has_bristles(p) ? bristle_rate(m.velocity, state[0], p) : 0.0;
}

void LuGre::switches(const Motion& m, const double* /*p*/, std::vector<double>& g) const {
  g.push_back(m.velocity);  // kink of |v|
}

}  // namespace plumbline::effects
