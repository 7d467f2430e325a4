#include "simulator/effects/spring.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kStiffness, kRest };

}  // namespace

const Declaration& Spring::declaration() const {
  static const Declaration kDeclaration{
      "spring",
      "a linear spring",
      "f = -stiffness*(x - rest)",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equation 28 (term K_B)",
      {Place::coordinate},
      {non_negative("stiffness", "{force}/{position}", "stiffness"), rest()},
      {},
      ""};
  return kDeclaration;
}

Values Spring::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.position, s.position};
}

std::vector<Values> Spring::starts(const Scales& scales) const {
  return starts_at_rests(null_values(), kRest, scales, {-2.0, -0.6, 0.0, 0.6, 2.0});
}

bool Spring::is_null(const double* p) const { return p[kStiffness] == 0.0; }

double Spring::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kStiffness] * (m.position - p[kRest]);
}

double Spring::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = m.position - p[kRest];
  return 0.5 * p[kStiffness] * d * d;
}

}  // namespace plumbline::effects
