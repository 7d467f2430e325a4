#include "simulator/effects/quadratic.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kDrag };

}  // namespace

const Declaration& Quadratic::declaration() const {
  static const Declaration kDeclaration{
      "quadratic",
      "drag in proportion to the square of the velocity",
      "f = -drag*|v|*v",
      "Batchelor, An Introduction to Fluid Dynamics, 1967 (drag at high Reynolds number)",
      {Place::coordinate, Place::motor},
      {non_negative("drag", "{force} s^2/{position}^2", "drag coefficient")},
      {},
      ""};
  return kDeclaration;
}

Values Quadratic::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / (s.velocity * s.velocity)};
}

std::vector<Values> Quadratic::starts(const Scales& /*scales*/) const { return {null_values()}; }

double Quadratic::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kDrag] * std::abs(m.velocity) * m.velocity;
}

}  // namespace plumbline::effects
