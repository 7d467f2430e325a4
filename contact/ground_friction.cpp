#include "contact/ground_friction.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::contact {
namespace {

using Eigen::Vector2d;

enum Index : std::size_t { kBristleStiffness, kBristleDamping, kFriction, kViscous, kRelaxation, kLateral };

// A hundredth of a second: flights of legged robots last ten times as long, contacts respond faster.
constexpr double kStandardRelaxation = 0.01;

bool has_bristles(const double* p) { return p[kFriction] > 0.0; }

// What the bristles see of a slip, and what of their force comes through: the same share sideways.
Vector2d with_lateral(const Vector2d& v, const double* p) { return {v.x(), p[kLateral] * v.y()}; }

Vector2d bristles(const double* state) { return {state[0], state[1]}; }

// Of bristles under load.
Vector2d bristle_rate(const Vector2d& slip, const Vector2d& d, const double* p) {
  return slip - p[kBristleStiffness] * slip.norm() / p[kFriction] * d;
}

}  // namespace

const effects::Declaration& GroundFriction::declaration() const {
  static const effects::Declaration kDeclaration{
      "ground_friction",
      "friction of a foot on bristles that deflect before it slides",
      "f_x = -normal*(bristle_stiffness*bristle_x + bristle_damping*bristle_x_rate + viscous*v_x); "
      "f_y = -lateral*normal*(bristle_stiffness*bristle_y + bristle_damping*bristle_y_rate + "
      "viscous*lateral*v_y); "
      "bristle_x_rate = v_x - decay*bristle_x if normal > 0 else -bristle_x/relaxation; "
      "bristle_y_rate = lateral*v_y - decay*bristle_y if normal > 0 else -bristle_y/relaxation; "
      "decay = bristle_stiffness*sqrt(v_x^2 + (lateral*v_y)^2)/friction",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equations 30 to 32; Canudas de Wit, Olsson, Astrom and "
      "Lischinsky, IEEE Trans. Automatic Control 40(3), 1995; in the plane: Velenis, Tsiotras, Canudas de "
      "Wit "
      "and Sorine, Vehicle System Dynamics 43(1), 2005",
      {effects::Place::foot},
      {effects::positive("bristle_stiffness", "1/m", "stiffness of the bristles, sigma_0", 1e3),
       effects::non_negative("bristle_damping", "s/m", "damping of the bristles, sigma_1"),
       effects::non_negative("friction", "1", "coefficient of friction of steady sliding, alpha_0"),
       effects::non_negative("viscous", "s/m", "rise of the coefficient with speed, alpha_2"),
       effects::fixed("relaxation", "s", "time constant with which unloaded bristles straighten",
                      kStandardRelaxation, 1e-6, 1.0),
       effects::fixed("lateral", "1", "share of the slip across the foot that is felt; 0: it rolls sideways",
                      1.0, 0.0, 1.0)},
      {"bristle_x", "bristle_y"},
      "Not negative at constant normal force and |bristle| <= friction/bristle_stiffness, which the state "
      "never "
      "leaves once inside. A normal force that rises while bristles are bent stiffens them: it adds at most "
      "friction^2/(2*bristle_stiffness) J/N, which is not in this power."};
  return kDeclaration;
}

effects::Values GroundFriction::typical(const effects::Scales& scales) const {
  const effects::Scales s = effects::guarded(scales);
  return {1.0 / (0.1 * s.position), 1.0 / s.velocity, 1.0, 1.0 / s.velocity, kStandardRelaxation, 1.0};
}

std::vector<effects::Values> GroundFriction::starts(const effects::Scales& scales) const {
  const effects::Scales s = effects::guarded(scales);
  std::vector<effects::Values> grid;
  for (const double friction : {0.1, 0.3, 1.0}) {
    for (const double share : {0.01, 0.1}) {  // presliding deflection as a share of the motion
      effects::Values p = null_values();
      p[kFriction] = friction;
      p[kBristleStiffness] = friction / (share * s.position);
      grid.push_back(p);
    }
  }
  return grid;
}

bool GroundFriction::is_null(const double* p) const { return !has_bristles(p) && p[kViscous] == 0.0; }

bool GroundFriction::is_isotropic(const double* p) const { return p[kLateral] == 1.0; }

Vector2d GroundFriction::force(const Vector2d& slip, double normal, const double* state,
                               const double* p) const {
  if (!(normal > 0.0)) return Vector2d::Zero();
  const Vector2d v = with_lateral(slip, p);
  Vector2d mu = p[kViscous] * v;
  if (has_bristles(p)) {
    const Vector2d d = bristles(state);
    mu += p[kBristleStiffness] * d + p[kBristleDamping] * bristle_rate(v, d, p);
  }
  return -normal * with_lateral(mu, p);
}

void GroundFriction::state_rate(const Vector2d& slip, double normal, const double* state, const double* p,
                                double* rate) const {
  const Vector2d d = bristles(state);
  const bool loaded = normal > 0.0 && has_bristles(p);
  const Vector2d result = loaded ? bristle_rate(with_lateral(slip, p), d, p) : Vector2d(-d / p[kRelaxation]);
  rate[0] = result.x();
  rate[1] = result.y();
}

double GroundFriction::stored_energy(double normal, const double* state, const double* p) const {
  if (!(normal > 0.0) || !has_bristles(p)) return 0.0;
  return 0.5 * normal * p[kBristleStiffness] * bristles(state).squaredNorm();
}

double GroundFriction::dissipated_power(const Vector2d& slip, double normal, const double* state,
                                        const double* p) const {
  if (!(normal > 0.0)) return 0.0;
  const Vector2d v = with_lateral(slip, p);
  double power = p[kViscous] * v.squaredNorm();
  if (has_bristles(p)) {
    const Vector2d d = bristles(state);
    const Vector2d rate = bristle_rate(v, d, p);
    power += p[kBristleStiffness] * d.dot(v - rate) + p[kBristleDamping] * rate.dot(v);
  }
  return normal * power;
}

// The bristles' deflection before they slide stays.
void GroundFriction::apply(const GroundChange& change, double* p) const {
  p[kBristleStiffness] *= change.friction;
  p[kFriction] *= change.friction;
  p[kViscous] *= change.friction;
}

}  // namespace plumbline::contact
