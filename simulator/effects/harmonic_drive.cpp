#include "simulator/effects/harmonic_drive.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kSoft, kStiff, kWindup, kDamping };

double soft_part(double x, const double* p) { return std::min(std::max(x, -p[kWindup]), p[kWindup]); }

}  // namespace

const Declaration& HarmonicDrive::declaration() const {
  static const Declaration kDeclaration{
      "harmonic_drive",
      "a strain wave gear: soft while its windup is small, stiff beyond",
      "f = -(stiffness_soft*s + stiffness_stiff*(x - s) + damping*v); s = min(max(x, -windup), windup)",
      "Tuttle and Seering, A nonlinear model of a harmonic drive gear transmission, IEEE Trans. Robotics and "
      "Automation 12(3), 1996; stiffness by pieces as its makers' data sheets give it",
      {Place::ratio},
      {Parameter{"stiffness_soft", "{force}/{position}",
                 "stiffness of the small windup, felt at the motor; infinite: rigid", kInfinity,
                 kSmallestPositive, kInfinity, Scale::reciprocal, false},
       positive("stiffness_stiff", "{force}/{position}", "stiffness beyond it, felt at the motor", 1e3),
       positive("windup", "{position}", "at which the gear stiffens, felt at the motor", 0.1),
       non_negative("damping", "{force} s/{position}", "damping felt at the motor")},
      {},
      ""};
  return kDeclaration;
}

Values HarmonicDrive::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.position, 3.0 * s.force / s.position, 0.3 * s.position, s.force / s.velocity};
}

// Of the usual torque a third winds the soft part up; beyond it the gear is two to three times as stiff (data
// sheets: K2/K1 from 1.3 to 2, K3/K1 to 3). Damped as what creeps back rather than swings.
std::vector<Values> HarmonicDrive::starts(const Scales& scales) const {
  constexpr double kStiffer = 2.5;
  constexpr double kShareOfTorque = 0.3;
  constexpr double kDampingRatio = 0.3;
  const Scales s = guarded(scales);
  std::vector<Values> grid;
  for (const double frequency : {6.0, 18.0, 50.0, 150.0}) {
    const double rate = 2.0 * kPi * frequency;
    const double soft = s.inertia * rate * rate;
    grid.push_back(
        {soft, kStiffer * soft, kShareOfTorque * s.force / soft, 2.0 * kDampingRatio * s.inertia * rate});
  }
  return grid;
}

bool HarmonicDrive::is_null(const double* p) const { return std::isinf(p[kSoft]); }

double HarmonicDrive::force(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  const double soft = soft_part(m.position, p);
  return -(p[kSoft] * soft + p[kStiff] * (m.position - soft) + p[kDamping] * m.velocity);
}

double HarmonicDrive::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  if (is_null(p)) return 0.0;
  const double soft = soft_part(m.position, p);
  const double beyond = m.position - soft;
  return p[kSoft] * soft * (0.5 * soft + beyond) + 0.5 * p[kStiff] * beyond * beyond;
}

double HarmonicDrive::dissipated_power(const Motion& m, const double* /*state*/, const double* p) const {
  return is_null(p) ? 0.0 : p[kDamping] * m.velocity * m.velocity;
}

void HarmonicDrive::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  g.push_back(m.position - p[kWindup]);
  g.push_back(m.position + p[kWindup]);
}

}  // namespace plumbline::effects
