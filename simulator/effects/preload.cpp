#include "simulator/effects/preload.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kPreload };

}  // namespace

const Declaration& Preload::declaration() const {
  static const Declaration kDeclaration{
      "preload",
      "a constant force",
      "f = -preload",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, Figure 17 (springs fitted with a preload)",
      {Place::coordinate},
      {any("preload", "{force}", "force, positive against the coordinate")},
      {},
      ""};
  return kDeclaration;
}

Values Preload::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force};
}

std::vector<Values> Preload::starts(const Scales& /*scales*/) const { return {null_values()}; }

double Preload::force(const Motion& /*m*/, const double* /*state*/, const double* p) const {
  return -p[kPreload];
}

double Preload::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  return p[kPreload] * m.position;
}

}  // namespace plumbline::effects
