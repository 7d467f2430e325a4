#include "simulator/effects/hard_stop.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t {
  kCubicStiffness,
  kDamping,
  kRootDamping,
  kPosition,
  kSide,
  kRootSpeed,
  kRounding,
  kStiffness,
  kPulls
};

double penetration(const Motion& m, const double* p) { return p[kSide] * (m.position - p[kPosition]); }

// Against a penetration that grows at `rate`.
double damping_force(double rate, const double* p) {
  const double root = std::sqrt((std::max(rate, 0.0) + p[kRounding]) / p[kRootSpeed]);
  return p[kDamping] * rate + p[kRootDamping] * (root - std::sqrt(p[kRounding] / p[kRootSpeed]));
}

// Against a penetration d that grows at `rate`, were the surfaces glued.
double push(double d, double rate, const double* p) {
  return p[kStiffness] * d + p[kCubicStiffness] * d * d * d + damping_force(rate, p);
}

// Of the glued surfaces' pull, what they do not pull.
double let_go(double push, const double* p) { return std::max(push, -p[kPulls] * std::abs(push)) - push; }

}  // namespace

const Declaration& HardStop::declaration() const {
  static const Declaration kDeclaration{
      "hard_stop",
      "a stiff, damped contact beyond a position",
      "f = -side*max(push, -pulls*|push|) if d > 0 else 0; push = stiffness*d + cubic_stiffness*d^3 + "
      "damping*d_rate + root_damping*(sqrt((max(d_rate, 0) + rounding)/root_speed) - "
      "sqrt(rounding/root_speed)); d = side*(x - position); d_rate = side*v",
      "Park, Sreenath, Hurst and Grizzle, Identification of a Bipedal Robot with a Compliant Drivetrain, "
      "IEEE Control Systems Magazine 31(2), 2011, equation 28 (branches of the stop) and Table VIII",
      {Place::coordinate},
      {non_negative("cubic_stiffness", "{force}/{position}^3", "cubic stiffness, K_d1"),
       non_negative("damping", "{force} s/{position}", "damping, K_vd1"),
       non_negative("root_damping", "{force}", "damping force while moving in at root_speed, K_vd2"),
       any("position", "{position}", "position where the stop begins"), fixed_side(),
       fixed("root_speed", "{position}/s", "speed that the root is taken relative to", 1.0, kSmallestPositive,
             kInfinity),
       fixed("rounding", "{position}/s",
             "speed by which the root begins earlier, so that its slope is finite", 0.0, 0.0, kInfinity),
       non_negative("stiffness", "{force}/{position}", "linear stiffness"),
       fixed("pulls", "1",
             "1: damping may pull on what leaves the stop, as in equation 28; 0: it never pulls", 0.0, 0.0,
             1.0)},
      {},
      ""};
  return kDeclaration;
}

Values HardStop::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / (s.position * s.position * s.position),
          s.force / s.velocity,
          s.force / std::sqrt(s.velocity),
          s.position,
          1.0,
          1.0,
          1e-3 * s.velocity,
          s.force / s.position,
          1.0};
}

std::vector<Values> HardStop::starts(const Scales& scales) const {
  const Scales s = guarded(scales);
  std::vector<Values> grid;
  for (const double side : {1.0, -1.0}) {
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
      Values p = null_values();
      p[kPosition] = s.center + side * share * s.position;
      p[kSide] = side;
      grid.push_back(p);
    }
  }
  return grid;
}

bool HardStop::is_null(const double* p) const {
  return p[kCubicStiffness] == 0.0 && p[kDamping] == 0.0 && p[kRootDamping] == 0.0 && p[kStiffness] == 0.0;
}

double HardStop::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = penetration(m, p);
  if (d <= 0.0) return 0.0;
  const double glued = push(d, p[kSide] * m.velocity, p);
  return -p[kSide] * (glued + let_go(glued, p));
}

double HardStop::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = std::max(penetration(m, p), 0.0);
  return 0.5 * p[kStiffness] * d * d + 0.25 * p[kCubicStiffness] * d * d * d * d;
}

double HardStop::dissipated_power(const Motion& m, const double* /*state*/, const double* p) const {
  const double d = penetration(m, p);
  if (d <= 0.0) return 0.0;
  const double rate = p[kSide] * m.velocity;
  return (damping_force(rate, p) + let_go(push(d, rate, p), p)) * rate;
}

void HardStop::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  const double d = penetration(m, p);
  g.push_back(d);
  // The root's slope is unbounded where motion turns, unless it is rounded; outside the stop that is of no
  // interest. (All change sign together where motion leaves the stop.)
  g.push_back(d > 0.0 && p[kRounding] <= 0.0 ? p[kSide] * m.velocity : 1.0);
  // Surfaces that do not pull part when this falls through zero: the force bends there, and does not jump.
  g.push_back(d > 0.0 && p[kPulls] < 1.0 ? push(d, p[kSide] * m.velocity, p) : 1.0);
}

int HardStop::jumps(const double* p) const { return p[kDamping] > 0.0 || p[kRootDamping] > 0.0 ? 1 : 0; }

}  // namespace plumbline::effects
