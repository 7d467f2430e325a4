#include "simulator/effects/cogging.h"

#include <cmath>
#include <cstddef>
#include <iterator>
#include <numeric>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kSine, kCosine, kCycles };

// Every count of small motors: poles, slots, their sums, the two of a strain wave gear; above it least common
// multiples of slots and poles. A neighbour's count explains a part only. Once in a turn is left to gravity.
constexpr int kFewest = 2;
constexpr int kMost = 48;
constexpr int kMultiples[] = {60, 72, 84};

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
  std::vector<int> counts(kMost - kFewest + 1);
  std::iota(counts.begin(), counts.end(), kFewest);
  counts.insert(counts.end(), std::begin(kMultiples), std::end(kMultiples));
  std::vector<Values> grid;
  for (const int cycles : counts) {
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
