#include "simulator/effects/unilateral_spring.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kStiffness, kPreload, kRest, kSide, kSmoothingLength };

/// What samples can show of the deflection over which the preload builds up: the way between two of them.
double resolution(const Scales& s) { return std::max(1e-3 * s.position, s.velocity * s.period); }

double deflection(const Motion& m, const double* p) { return p[kSide] * (m.position - p[kRest]); }

// ln cosh(a) for a >= 0, without overflow.
double log_cosh(double a) { return a + std::log1p(std::exp(-2.0 * a)) - std::log(2.0); }

}  // namespace

const Declaration& UnilateralSpring::declaration() const {
  static const Declaration kDeclaration{
      "unilateral_spring",
      "a spring that acts on one side of its rest position only",
      "f = -side*(stiffness*d + preload*tanh(d/smoothing_length)) if d > 0 else 0; d = side*(x - rest)",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equation 28 and Figure 17; Poulakakis and Grizzle, "
      "Modeling and Control of the Monopedal Robot Thumper",
      {Place::coordinate},
      {non_negative("stiffness", "{force}/{position}", "stiffness"),
       non_negative("preload", "{force}", "force at the beginning of the deflection"),
       any("rest", "{position}", "position where the spring begins"), fixed_side(),
       positive("smoothing_length", "{position}", "deflection over which the preload builds up", 1e-3)},
      {},
      ""};
  return kDeclaration;
}

Values UnilateralSpring::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.position, s.force, s.position, 1.0, resolution(s)};
}

std::vector<Values> UnilateralSpring::starts(const Scales& scales) const {
  const Scales s = guarded(scales);
  std::vector<Values> grid;
  for (const double side : {1.0, -1.0}) {
    for (const double share : {0.0, -0.2, 0.2, -0.4, 0.4, -0.6, 0.6}) {
      Values p = null_values();
      p[kRest] = s.center + share * s.position;
      p[kSide] = side;
      p[kSmoothingLength] = resolution(s);
      grid.push_back(p);
    }
  }
  return grid;
}

bool UnilateralSpring::is_null(const double* p) const { return p[kStiffness] == 0.0 && p[kPreload] == 0.0; }

double UnilateralSpring::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = deflection(m, p);
  if (d <= 0.0) return 0.0;
  return -p[kSide] * (p[kStiffness] * d + p[kPreload] * std::tanh(d / p[kSmoothingLength]));
}

double UnilateralSpring::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = deflection(m, p);
  if (d <= 0.0) return 0.0;
  return 0.5 * p[kStiffness] * d * d + p[kPreload] * p[kSmoothingLength] * log_cosh(d / p[kSmoothingLength]);
}

void UnilateralSpring::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  g.push_back(deflection(m, p));
}

}  // namespace plumbline::effects
