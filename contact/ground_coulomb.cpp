#include "contact/ground_coulomb.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::contact {
namespace {

using Eigen::Vector2d;

enum Index : std::size_t { kFriction, kViscous, kSlipSpeed, kLateral };

constexpr double kStandardSlipSpeed = 0.01;  // m/s

// What is felt of a slip, and what of the force comes through: the same share sideways.
Vector2d felt(const Vector2d& v, const double* p) { return {v.x(), p[kLateral] * v.y()}; }

// Of the felt slip's speed: coefficient of friction over speed, s/m.
double drag(double speed, const double* p) {
  constexpr double kStill = 1e-8;  // below it tanh(x) / x is 1 to rounding
  const double x = speed / p[kSlipSpeed];
  return p[kFriction] / p[kSlipSpeed] * (x > kStill ? std::tanh(x) / x : 1.0) + p[kViscous];
}

}  // namespace

const effects::Declaration& GroundCoulomb::declaration() const {
  static const effects::Declaration kDeclaration{
      "ground_coulomb",
      "Coulomb friction of a foot against its slip, smooth at standstill",
      "f_x = -normal*drag*v_x; f_y = -lateral*normal*drag*lateral*v_y; "
      "drag = friction*tanh(v/slip_speed)/v + viscous; v = sqrt(v_x^2 + (lateral*v_y)^2)",
      "Andersson, Soderberg and Bjorklund, Friction models for sliding dry, boundary and mixed lubricated "
      "contacts, Tribology International 40, 2007, 580-587",
      {effects::Place::foot},
      {effects::non_negative("friction", "1", "coefficient of friction of sliding"),
       effects::non_negative("viscous", "s/m", "rise of the coefficient with speed"),
       effects::fixed("slip_speed", "m/s", "speed of the slip below which the friction fades",
                      kStandardSlipSpeed, 1e-6, 10.0),
       effects::fixed("lateral", "1", "share of the slip across the foot that is felt; 0: it rolls sideways",
                      1.0, 0.0, 1.0)},
      {},
      ""};
  return kDeclaration;
}

effects::Values GroundCoulomb::typical(const effects::Scales& scales) const {
  return {1.0, 1.0 / effects::guarded(scales).velocity, kStandardSlipSpeed, 1.0};
}

std::vector<effects::Values> GroundCoulomb::starts(const effects::Scales& /*scales*/) const {
  return {null_values()};
}

bool GroundCoulomb::is_isotropic(const double* p) const { return p[kLateral] == 1.0; }

Vector2d GroundCoulomb::force(const Vector2d& slip, double normal, const double* /*state*/,
                              const double* p) const {
  if (!(normal > 0.0)) return Vector2d::Zero();
  const Vector2d v = felt(slip, p);
  return -normal * drag(v.norm(), p) * felt(v, p);
}

double GroundCoulomb::dissipated_power(const Vector2d& slip, double normal, const double* /*state*/,
                                       const double* p) const {
  if (!(normal > 0.0)) return 0.0;
  const Vector2d v = felt(slip, p);
  return normal * drag(v.norm(), p) * v.squaredNorm();
}

// The speed below which it fades stays.
void GroundCoulomb::apply(const GroundChange& change, double* p) const {
  p[kFriction] *= change.friction;
  p[kViscous] *= change.friction;
}

}  // namespace plumbline::contact
