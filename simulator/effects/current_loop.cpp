#include "simulator/effects/current_loop.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kTimeConstant, kDampingRatio };
enum State : std::size_t { kDelivered, kSlope };

}  // namespace

const Declaration& CurrentLoop::declaration() const {
  static const Declaration kDeclaration{
      "current_loop",
      "a current loop of second order: it overshoots, or rounds a step off",
      "torque = delivered; delivered_rate = slope; slope_rate = ((u - delivered)/time_constant - "
      "2*damping_ratio*slope)/time_constant",
      "Astrom and Murray, Feedback Systems, 2008, section 6.3 (second-order systems)",
      {Place::motor},
      {non_negative("time_constant", "s", "one over its natural frequency in rad/s"),
       positive("damping_ratio", "1", "damping over the critical one", 0.7)},
      {"delivered", "slope"},
      ""};
  return kDeclaration;
}

Values CurrentLoop::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position / s.velocity, 0.7};
}

// As of a winding: a short one delays in proportion to its time constant.
std::vector<Values> CurrentLoop::starts(const Scales& scales) const {
  const double period = guarded(scales).period;
  return {{0.1 * period, 0.7}, {0.5 * period, 0.7}, {3.0 * period, 0.4}};
}

bool CurrentLoop::is_null(const double* p) const { return p[kTimeConstant] == 0.0; }

double CurrentLoop::torque(double commanded, const double* state, const double* p) const {
  return is_null(p) ? commanded : state[kDelivered];
}

void CurrentLoop::state_rate(double commanded, const double* state, const double* p, double* rate) const {
  rate[kDelivered] = is_null(p) ? 0.0 : state[kSlope];
  rate[kSlope] =
      is_null(p)
          ? 0.0
          : ((commanded - state[kDelivered]) / p[kTimeConstant] - 2.0 * p[kDampingRatio] * state[kSlope]) /
                p[kTimeConstant];
}

void CurrentLoop::settle(double commanded, const double* /*p*/, double* state) const {
  state[kDelivered] = commanded;
  state[kSlope] = 0.0;
}

}  // namespace plumbline::effects
