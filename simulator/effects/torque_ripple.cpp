#include "simulator/effects/torque_ripple.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kSine, kCosine, kCycles };

// Twice and six times the pole pairs are even; slots of three phases are multiples of three.
bool is_usual(int cycles) { return cycles % 2 == 0 || (cycles % 3 == 0 && cycles >= 9); }

constexpr int kFewest = 2;
constexpr int kMost = 48;

}  // namespace

const Declaration& TorqueRipple::declaration() const {
  static const Declaration kDeclaration{
      "torque_ripple",
      "a torque that pulses with the motor's angle, in proportion to itself",
      "f = load*(sine*sin(cycles*x) + cosine*cos(cycles*x))",
      "Jahns and Soong, Pulsating torque minimization techniques for permanent magnet AC motor drives: a "
      "review, IEEE Trans. Industrial Electronics 43(2), 1996, section II",
      {Place::motor},
      {any("sine", "1", "amplitude of the sine over the torque"),
       any("cosine", "1", "amplitude of the cosine over the torque"),
       fixed("cycles", "1", "cycles per 2 pi of the motor's position", 6.0, kSmallestPositive, kInfinity)},
      {},
      "Negative where the pulse helps the motion: the supply gives what the motor gives more."};
  return kDeclaration;
}

Values TorqueRipple::typical(const Scales& /*scales*/) const { return {1.0, 1.0, 6.0}; }

std::vector<Values> TorqueRipple::starts(const Scales& /*scales*/) const {
  std::vector<Values> grid;
  for (int cycles = kFewest; cycles <= kMost; ++cycles) {
    if (is_usual(cycles)) {
      Values p = null_values();
      p[kCycles] = cycles;
      grid.push_back(p);
    }
  }
  return grid;
}

double TorqueRipple::force(const Motion& m, const double* /*state*/, const double* p) const {
  const double angle = p[kCycles] * m.position;
  return m.load * (p[kSine] * std::sin(angle) + p[kCosine] * std::cos(angle));
}

}  // namespace plumbline::effects
