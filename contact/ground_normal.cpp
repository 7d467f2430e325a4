#include "contact/ground_normal.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::contact {
namespace {

enum Index : std::size_t {
  kStiffness,
  kDamping,
  kRootDamping,
  kExponent,
  kReferenceDepth,
  kRootSpeed,
  kRounding
};

constexpr double kSphericalFoot = 1.5;

// Share of the force at the reference depth; the depth is positive.
double contact_share(double depth, const double* p) {
  return std::pow(depth / p[kReferenceDepth], p[kExponent]);
}

double damping_force(double rate, const double* p) {
  const double root =
      std::sqrt((std::abs(rate) + p[kRounding]) / p[kRootSpeed]) - std::sqrt(p[kRounding] / p[kRootSpeed]);
  return p[kDamping] * rate + p[kRootDamping] * std::copysign(root, rate);
}

}  // namespace

const effects::Declaration& GroundNormal::declaration() const {
  static const effects::Declaration kDeclaration{
      "ground_normal",
      "a compliant, damped ground under a point foot",
      "normal = max(0, (depth/reference_depth)^exponent*(stiffness + damping*rate + "
      "root_damping*sgn(rate)*(sqrt((|rate| + rounding)/root_speed) - sqrt(rounding/root_speed)))) if depth "
      "> "
      "0 else 0",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equation 29 and Table VIII, with damping that opposes the "
      "motion; Hunt and Crossley, J. Applied Mechanics 42, 1975",
      {effects::Place::foot},
      {effects::non_negative("stiffness", "N", "elastic force at the reference depth, k"),
       effects::non_negative("damping", "N s/m", "damping at the reference depth, lambda_a"),
       effects::non_negative("root_damping", "N",
                             "damping force at the reference depth and at root_speed, lambda_b"),
       effects::fixed("exponent", "1", "power of the depth, by the shapes in contact, n", kSphericalFoot, 1.0,
                      3.0),
       effects::fixed("reference_depth", "m", "depth that the coefficients are stated at", 1.0,
                      effects::kSmallestPositive, effects::kInfinity),
       effects::fixed("root_speed", "m/s", "speed that the root is taken relative to", 1.0,
                      effects::kSmallestPositive, effects::kInfinity),
       effects::fixed("rounding", "m/s",
                      "speed by which the root begins earlier, so that its slope is finite", 0.0, 0.0,
                      effects::kInfinity)},
      {},
      ""};
  return kDeclaration;
}

effects::Values GroundNormal::typical(const effects::Scales& scales) const {
  const effects::Scales s = effects::guarded(scales);
  const double at_reference = s.force / std::pow(s.position, kSphericalFoot);
  return {at_reference, at_reference / s.velocity, at_reference / std::sqrt(s.velocity), kSphericalFoot, 1.0,
          1.0,          1e-3 * s.velocity};
}

std::vector<effects::Values> GroundNormal::starts(const effects::Scales& /*scales*/) const {
  return {null_values()};  // linear in the coefficients
}

double GroundNormal::force(double depth, double rate, const double* p) const {
  if (depth <= 0.0) return 0.0;
  return contact_share(depth, p) * std::max(p[kStiffness] + damping_force(rate, p), 0.0);
}

double GroundNormal::stored_energy(double depth, const double* p) const {
  if (depth <= 0.0) return 0.0;
  return p[kStiffness] * depth * contact_share(depth, p) / (p[kExponent] + 1.0);
}

double GroundNormal::dissipated_power(double depth, double rate, const double* p) const {
  if (depth <= 0.0) return 0.0;
  // Where the ground would have to pull it lets go: the elastic force then does its work on nothing.
  return contact_share(depth, p) * std::max(damping_force(rate, p), -p[kStiffness]) * rate;
}

void GroundNormal::switches(double depth, double rate, const double* p, std::vector<double>& g) const {
  const bool inside = depth > 0.0;
  g.push_back(depth);
  g.push_back(inside && p[kRootDamping] > 0.0 && p[kRounding] <= 0.0 ? rate : 1.0);
  g.push_back(inside ? p[kStiffness] + damping_force(rate, p) : 1.0);
}

void GroundNormal::apply(const GroundChange& change, double* p) const {
  p[kStiffness] *= change.stiffness;
  p[kDamping] *= change.damping;
  p[kRootDamping] *= change.damping;
}

}  // namespace plumbline::contact
