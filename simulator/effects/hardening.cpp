#include "simulator/effects/hardening.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kCubicStiffness, kRest };

}  // namespace

const Declaration& Hardening::declaration() const {
  static const Declaration kDeclaration{
      "hardening",
      "the cubic part of a spring that hardens (or softens)",
      "f = -cubic_stiffness*(x - rest)^3",
      "Kovacic and Brennan, The Duffing Equation, 2011",
      {Place::coordinate},
      {any("cubic_stiffness", "{force}/{position}^3", "cubic stiffness; negative: softens"), rest()},
      {},
      ""};
  return kDeclaration;
}

Values Hardening::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / (s.position * s.position * s.position), s.position};
}

std::vector<Values> Hardening::starts(const Scales& scales) const {
  return starts_at_rests(null_values(), kRest, scales, {-1.0, -0.3, 0.0, 0.3, 1.0});
}

bool Hardening::is_null(const double* p) const { return p[kCubicStiffness] == 0.0; }

double Hardening::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = m.position - p[kRest];
  return -p[kCubicStiffness] * d * d * d;
}

double Hardening::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = m.position - p[kRest];
  return 0.25 * p[kCubicStiffness] * d * d * d * d;
}

}  // namespace plumbline::effects
