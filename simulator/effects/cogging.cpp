#include "simulator/effects/cogging.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kSine, kCosine, kCycles };

// Usual counts: poles, slots, and their products and sums for small motors.
constexpr double kCyclesPerTurn[] = {4, 6, 7, 8, 10, 12, 14, 16, 18, 20, 21, 22, 24, 28, 30, 32, 36, 42, 48};

}  // namespace

const Declaration& Cogging::declaration() const {
  static const Declaration kDeclaration{
      "cogging",
      "a torque that repeats with the motor's angle",
      "f = -(sine*sin(cycles*x) + cosine*cos(cycles*x))",
      "Holtz and Springob, Identification and compensation of torque ripple in high-precision permanent "
      "magnet motor drives, IEEE Trans. Industrial Electronics 43(2), 1996",
      {Place::motor},
      {any("sine", "{force}", "amplitude of the sine"), any("cosine", "{force}", "amplitude of the cosine"),
       fixed("cycles", "1", "cycles per 2 pi of the motor's position", 1.0, kSmallestPositive, kInfinity)},
      {},
      ""};
  return kDeclaration;
}

Values Cogging::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force, s.force, 1.0};
}

std::vector<Values> Cogging::starts(const Scales& /*scales*/) const {
  std::vector<Values> grid;
  for (const double cycles : kCyclesPerTurn) {
    Values p = null_values();
    p[kCycles] = cycles;
    grid.push_back(p);
  }
  return grid;
}

double Cogging::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double angle = p[kCycles] * m.position;
  return -(p[kSine] * std::sin(angle) + p[kCosine] * std::cos(angle));
}

double Cogging::stored_energy(const Motion& m, const double* /*state*/, const double* p) const {
  const double angle = p[kCycles] * m.position;
  return (p[kCosine] * std::sin(angle) - p[kSine] * std::cos(angle)) / p[kCycles];
}

}  // namespace plumbline::effects
