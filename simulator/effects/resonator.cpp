#include "simulator/effects/resonator.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kInertia, kFrequency, kDampingRatio };
enum State : std::size_t { kStretch, kSpeed };

double circular(const double* p) { return 2.0 * kPi * p[kFrequency]; }

/// Of the mass, along the link's motion. With the link's inertia the force of the spring and its damper.
double pull(const Motion& m, const double* state, const double* p) {
  const double w = circular(p);
  return w * (w * state[kStretch] + 2.0 * p[kDampingRatio] * (state[kSpeed] - m.velocity));
}

}  // namespace

const Declaration& Resonator::declaration() const {
  static const Declaration kDeclaration{
      "resonator",
      "a mass on a spring on a link: what rattles, sloshes or swings along",
      "f = inertia*pull; pull = w*(w*stretch + 2*damping_ratio*(speed - v)); w = "
      "2*pi*frequency; stretch_rate = speed - v; speed_rate = -pull",
      "Den Hartog, Mechanical Vibrations, 4th edition, 1956, section 3.2 (the dynamic vibration absorber)",
      {Place::coordinate},
      {non_negative("inertia", "{inertia}", "of the mass, along the coordinate"),
       positive("frequency", "Hz", "of the mass on its spring while the link is held", 10.0),
       positive("damping_ratio", "1", "damping of its spring over the critical one", 0.1)},
      {"stretch", "speed"},
      ""};
  return kDeclaration;
}

Values Resonator::typical(const Scales& scales) const { return {guarded(scales).inertia, 10.0, 0.1}; }

std::vector<Values> Resonator::starts(const Scales& scales) const {
  constexpr double kShare = 0.05;  // of the inertia that is felt there
  constexpr double kDamped = 0.1;  // bolted and glued parts, liquids with a free surface
  std::vector<Values> grid;
  for (const double frequency : {2.5, 5.0, 10.0, 20.0, 40.0}) {
    grid.push_back({kShare * guarded(scales).inertia, frequency, kDamped});
  }
  return grid;
}

bool Resonator::is_null(const double* p) const { return p[kInertia] == 0.0; }

double Resonator::force(const Motion& m, const double* state, const double* p) const {
  return is_null(p) ? 0.0 : p[kInertia] * pull(m, state, p);
}

double Resonator::stored_energy(const Motion& /*m*/, const double* state, const double* p) const {
  if (is_null(p)) return 0.0;
  const double w = circular(p);
  return 0.5 * p[kInertia] * (w * w * state[kStretch] * state[kStretch] + state[kSpeed] * state[kSpeed]);
}

double Resonator::dissipated_power(const Motion& m, const double* state, const double* p) const {
  if (is_null(p)) return 0.0;
  const double slip = state[kSpeed] - m.velocity;
  return 2.0 * p[kDampingRatio] * circular(p) * p[kInertia] * slip * slip;
}

void Resonator::state_rate(const Motion& m, const double* state, const double* p, double* rate) const {
  rate[kStretch] = is_null(p) ? 0.0 : state[kSpeed] - m.velocity;
  rate[kSpeed] = is_null(p) ? 0.0 : -pull(m, state, p);
}

}  // namespace plumbline::effects
