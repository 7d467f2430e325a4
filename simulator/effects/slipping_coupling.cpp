#include "simulator/effects/slipping_coupling.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kLimit, kStiffness, kDamping };

double windup_rate(double v, double windup, const double* p) {
  const double r = p[kStiffness] * windup / p[kLimit];
  const double square = r * r;
  const double slips = square * square * square * square;
  return v - 0.5 * slips * (v + std::abs(v) * (r < 0.0 ? -1.0 : 1.0));
}

}  // namespace

const Declaration& SlippingCoupling::declaration() const {
  static const Declaration kDeclaration{
      "slipping_coupling",
      "a coupling that slips: an elastic ratio whose torque is capped",
      "f = -(stiffness*windup + damping*windup_rate); windup_rate = v - 0.5*r^8*(v + |v|*sgn(r)); r = "
      "stiffness*windup/limit",
      "Wen, Method for random vibration of hysteretic systems, ASCE J. Engineering Mechanics Division "
      "102(2), 1976, with beta = gamma = 1/2 and the power 8",
      {Place::ratio},
      {Parameter{"limit", "{force}", "at which it slips, felt at the motor; infinite: rigid", kInfinity,
                 kSmallestPositive, kInfinity, Scale::reciprocal, false},
       positive("stiffness", "{force}/{position}", "below the limit, felt at the motor", 1e3),
       non_negative("damping", "{force} s/{position}", "below the limit, felt at the motor")},
      {"windup"},
      ""};
  return kDeclaration;
}

Values SlippingCoupling::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {0.3 * s.force, s.force / (0.1 * s.position), s.force / s.velocity};
}

// It must slip for a search to see it: at the peaks of the usual torque, and well below.
std::vector<Values> SlippingCoupling::starts(const Scales& scales) const {
  constexpr double kFrequency = 50.0;  // Hz: stiff beside what drives it
  constexpr double kDampingRatio = 0.3;
  const Scales s = guarded(scales);
  const double rate = 2.0 * kPi * kFrequency;
  std::vector<Values> grid;
  for (const double share : {1.5, 0.8}) {
    grid.push_back({share * s.force, s.inertia * rate * rate, 2.0 * kDampingRatio * s.inertia * rate});
  }
  return grid;
}

bool SlippingCoupling::is_null(const double* p) const { return std::isinf(p[kLimit]); }

double SlippingCoupling::force(const Motion& m, const double* state, const double* p) const {
  if (is_null(p)) return 0.0;
  return -(p[kStiffness] * state[0] + p[kDamping] * windup_rate(m.velocity, state[0], p));
}

double SlippingCoupling::stored_energy(const Motion& /*m*/, const double* state, const double* p) const {
  return is_null(p) ? 0.0 : 0.5 * p[kStiffness] * state[0] * state[0];
}

double SlippingCoupling::dissipated_power(const Motion& m, const double* state, const double* p) const {
  if (is_null(p)) return 0.0;
  const double rate = windup_rate(m.velocity, state[0], p);
  return p[kStiffness] * state[0] * (m.velocity - rate) + p[kDamping] * rate * m.velocity;
}

void SlippingCoupling::state_rate(const Motion& m, const double* state, const double* p, double* rate) const {
  rate[0] = is_null(p) ? 0.0 : windup_rate(m.velocity, state[0], p);
}

void SlippingCoupling::switches(const Motion& m, const double* /*p*/, std::vector<double>& g) const {
  g.push_back(m.velocity);  // kink of |v|
}

}  // namespace plumbline::effects
