#include "simulator/effects/cable_stretch.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kStiffness, kDamping };

// Of the stretch that a diagnosis starts from. Belts and light cables swing; the cables of a robot's legs
// hardly do: Park et al. found ratios from 1 to 5 (Table VIII).
constexpr double kSwinging = 0.3;
constexpr double kCreeping = 2.0;

}  // namespace

const Declaration& CableStretch::declaration() const {
  static const Declaration kDeclaration{
      "cable_stretch",
      "a damped spring in a ratio that was rigid",
      "f = -(stiffness*x + damping*v)",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equations 23 to 25 (with the sign that restores)",
      {Place::ratio},
      {Parameter{"stiffness", "{force}/{position}", "stiffness felt at the motor; infinite: rigid", kInfinity,
                 kSmallestPositive, kInfinity, Scale::reciprocal, false},
       non_negative("damping", "{force} s/{position}", "damping felt at the motor")},
      {},
      ""};
  return kDeclaration;
}

Values CableStretch::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.position, s.force / s.velocity};
}

std::vector<Values> CableStretch::starts(const Scales& scales) const {
  const double inertia = guarded(scales).inertia;
  std::vector<Values> grid;
  const auto add = [&](double frequency, double ratio) {
    const double rate = 2.0 * kPi * frequency;
    grid.push_back({inertia * rate * rate, 2.0 * ratio * inertia * rate});
  };
  add(6.0, kSwinging);
  for (const double frequency : {18.0, 50.0, 150.0}) {
    add(frequency, kSwinging);
    add(frequency, kCreeping);
  }
  add(450.0, kSwinging);  // where a light motor drives a heavy load it swings against the cable by itself
  return grid;
}

bool CableStretch::is_null(const double* p) const { return std::isinf(p[kStiffness]); }

double CableStretch::force(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  return -(p[kStiffness] * m.position + p[kDamping] * m.velocity);
}

double CableStretch::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  return 0.5 * p[kStiffness] * m.position * m.position;
}

double CableStretch::dissipated_power(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  return p[kDamping] * m.velocity * m.velocity;
}

}  // namespace plumbline::effects
