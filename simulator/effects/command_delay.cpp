#include "simulator/effects/command_delay.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDelay };

}  // namespace

const Declaration& CommandDelay::declaration() const {
  static const Declaration kDeclaration{"command_delay",
                                        "a command that takes effect later",
                                        "torque(t) = u(t - delay)",
                                        "Astrom and Murray, Feedback Systems, 2008 (time delay)",
                                        {Place::motor},
                                        {non_negative("delay", "s", "time between command and effect")},
                                        {},
                                        ""};
  return kDeclaration;
}

Values CommandDelay::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position / s.velocity};
}

std::vector<Values> CommandDelay::starts(const Scales& /*scales*/) const { return {null_values()}; }

double CommandDelay::torque(double commanded, const double* /*state*/, const double* /*p*/) const {
  return commanded;
}

double CommandDelay::delay(const double* p) const { return p[kDelay]; }

}  // namespace plumbline::effects
