#include "simulator/effects/actuator_lag.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kTimeConstant };

}  // namespace

const Declaration& ActuatorLag::declaration() const {
  static const Declaration kDeclaration{"actuator_lag",
                                        "an actuator that follows its command as a first-order lag",
                                        "torque = delivered; delivered_rate = (u - delivered)/time_constant",
                                        "Astrom and Murray, Feedback Systems, 2008 (first-order systems)",
                                        {Place::motor},
                                        {non_negative("time_constant", "s", "time constant of the lag")},
                                        {"delivered"},
                                        ""};
  return kDeclaration;
}

Values ActuatorLag::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position / s.velocity};
}

std::vector<Values> ActuatorLag::starts(const Scales& scales) const {
  const double period = guarded(scales).period;
  return {{0.1 * period}, {0.5 * period}, {3.0 * period}, {10.0 * period}};  // current loops, fast to slow
}

double ActuatorLag::torque(double commanded, const double* state, const double* p) const {
  return is_null(p) ? commanded : state[0];
}

void ActuatorLag::state_rate(double commanded, const double* state, const double* p, double* rate) const {
  rate[0] = is_null(p) ? 0.0 : (commanded - state[0]) / p[kTimeConstant];
}

void ActuatorLag::settle(double commanded, const double* /*p*/, double* state) const { state[0] = commanded; }

}  // namespace plumbline::effects
