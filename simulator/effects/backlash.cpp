#include "simulator/effects/backlash.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kGap, kStiffness, kDamping };

// The contact a diagnosis starts from is stiff beside what drives it: 60 Hz with a third of critical damping.
constexpr double kContactRate = 2.0 * kPi * 60.0;
constexpr double kContactDampingRatio = 0.3;

// What the stretch exceeds the half gap by, with sign; zero inside the gap.
double excess(double x, const double* p) { return x - std::min(std::max(x, -0.5 * p[kGap]), 0.5 * p[kGap]); }

// Size of the force between surfaces that push but never pull.
double contact_force(const Motion& m, double e, const double* p) {
  return std::max(0.0, p[kStiffness] * std::abs(e) + p[kDamping] * std::copysign(1.0, e) * m.velocity);
}

}  // namespace

const Declaration& Backlash::declaration() const {
  static const Declaration kDeclaration{
      "backlash",
      "play in a ratio, with a stiff damped contact on either side",
      "f = -sgn(e)*max(0, stiffness*|e| + damping*sgn(e)*v); e = x - min(max(x, -gap/2), gap/2)",
      "Nordin and Gutman, Controlling mechanical systems with backlash: a survey, Automatica 38, 2002",
      {Place::ratio},
      {non_negative("gap", "{position}", "free play of the motor, from contact to contact"),
       positive("stiffness", "{force}/{position}", "stiffness of the contact", 1e3),
       Parameter{"damping", "{force} s/{position}", "damping of the contact", 0.3, 0.0, kInfinity,
                 Scale::linear, false}},
      {},
      ""};
  return kDeclaration;
}

Values Backlash::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position, s.inertia * kContactRate * kContactRate,
          2.0 * kContactDampingRatio * s.inertia * kContactRate};
}

std::vector<Values> Backlash::starts(const Scales& scales) const {
  // Where a light motor drives a heavy load the contact may be far stiffer than kContactRate makes it.
  constexpr double kStifferRate = 7.0;
  const Values soft = typical(scales);
  const Values stiff = {soft[kGap], kStifferRate * kStifferRate * soft[kStiffness],
                        kStifferRate * soft[kDamping]};
  std::vector<Values> grid;
  for (Values p : {soft, stiff}) {
    // From play that the finest encoders just see to play as wide as the motion.
    for (const double share : {3e-4, 1e-3, 3e-3, 0.01, 0.03, 0.1, 0.3}) {
      p[kGap] = share * guarded(scales).position;
      grid.push_back(p);
    }
  }
  return grid;
}

bool Backlash::is_null(const double* p) const { return p[kGap] == 0.0; }

double Backlash::force(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  const double e = excess(m.position, p);
  return e == 0.0 ? 0.0 : -std::copysign(contact_force(m, e, p), e);
}

double Backlash::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  const double e = excess(m.position, p);
  return 0.5 * p[kStiffness] * e * e;
}

double Backlash::dissipated_power(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  const double e = excess(m.position, p);
  if (e == 0.0) return 0.0;
  // What the contact takes in, less what its spring stores.
  return std::copysign(contact_force(m, e, p), e) * m.velocity - p[kStiffness] * e * m.velocity;
}

void Backlash::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  const double e = excess(m.position, p);
  g.push_back(m.position - 0.5 * p[kGap]);
  g.push_back(m.position + 0.5 * p[kGap]);
  // The surfaces part when this falls through zero. Of interest in contact only.
  g.push_back(e == 0.0 ? 1.0
                       : p[kStiffness] * std::abs(e) + p[kDamping] * std::copysign(1.0, e) * m.velocity);
}

// Damping jumps where the surfaces meet, and the slopes there and where they part.
int Backlash::jumps(const double* p) const { return is_null(p) ? 0 : 3; }

}  // namespace plumbline::effects
