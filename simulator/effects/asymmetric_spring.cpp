#include "simulator/effects/asymmetric_spring.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kAbove, kBelow, kRest };

double stiffness(double d, const double* p) { return d > 0.0 ? p[kAbove] : p[kBelow]; }

}  // namespace

const Declaration& AsymmetricSpring::declaration() const {
  static const Declaration kDeclaration{
      "asymmetric_spring",
      "a spring that pulls with another stiffness than it pushes",
      "f = -stiffness_above*d if d > 0 else -stiffness_below*d; d = x - rest",
      "Shaw and Holmes, A periodically forced piecewise linear oscillator, J. Sound and Vibration 90(1), "
      "1983, equation 1",
      {Place::coordinate},
      {non_negative("stiffness_above", "{force}/{position}", "stiffness above the rest position"),
       non_negative("stiffness_below", "{force}/{position}", "stiffness below the rest position"), rest()},
      {},
      ""};
  return kDeclaration;
}

Values AsymmetricSpring::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.position, s.force / s.position, s.position};
}

// A corner that the motion does not pass makes a plain spring of it, which has its own name.
std::vector<Values> AsymmetricSpring::starts(const Scales& scales) const {
  return starts_at_rests(null_values(), kRest, scales, {-0.6, -0.3, 0.0, 0.3, 0.6});
}

bool AsymmetricSpring::is_null(const double* p) const { return p[kAbove] == 0.0 && p[kBelow] == 0.0; }

double AsymmetricSpring::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = m.position - p[kRest];
  return -stiffness(d, p) * d;
}

double AsymmetricSpring::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = m.position - p[kRest];
  return 0.5 * stiffness(d, p) * d * d;
}

void AsymmetricSpring::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  g.push_back(m.position - p[kRest]);
}

}  // namespace plumbline::effects
