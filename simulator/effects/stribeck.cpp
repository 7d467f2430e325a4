#include "simulator/effects/stribeck.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kLevel, kRise, kStribeckSpeed, kSmoothingSpeed };

}  // namespace

const Declaration& Stribeck::declaration() const {
  static const Declaration kDeclaration{
      "stribeck",
      "Coulomb friction that is higher at low speed",
      "f = -(level + rise*exp(-(v/stribeck_speed)^2))*tanh(v/smoothing_speed)",
      "Bo and Pavelescu, The friction-speed relation and its influence on the critical velocity of "
      "stick-slip motion, Wear 82, 1982; Armstrong-Helouvry, Dupont and Canudas de Wit, Automatica 30, 1994",
      {Place::coordinate, Place::motor},
      {non_negative("level", "{force}", "friction force at high speed"),
       non_negative("rise", "{force}", "what friction at low speed exceeds the level by"),
       positive("stribeck_speed", "{position}/s", "speed over which the rise fades", 0.1), smoothing_speed()},
      {},
      ""};
  return kDeclaration;
}

Values Stribeck::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force, s.force, s.velocity, smoothing_speed_for(scales)};
}

std::vector<Values> Stribeck::starts(const Scales& scales) const {
  std::vector<Values> grid;
  for (const double share : {0.1, 0.4}) {
    Values p = null_values();
    p[kStribeckSpeed] = share * guarded(scales).velocity;
    p[kSmoothingSpeed] = smoothing_speed_for(scales);
    grid.push_back(p);
  }
  return grid;
}

bool Stribeck::is_null(const double* p) const { return p[kLevel] == 0.0 && p[kRise] == 0.0; }

double Stribeck::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double u = m.velocity / p[kStribeckSpeed];
  return -(p[kLevel] + p[kRise] * std::exp(-u * u)) * smooth_sign(m.velocity, p[kSmoothingSpeed]);
}

}  // namespace plumbline::effects
