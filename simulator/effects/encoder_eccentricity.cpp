#include "simulator/effects/encoder_eccentricity.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kSine, kCosine, kWaves };

}  // namespace

const Declaration& EncoderEccentricity::declaration() const {
  static const Declaration kDeclaration{
      "encoder_eccentricity",
      "a code disc that does not sit on its axis: one or two waves a turn",
      "reading = actual + sine*sin(waves*actual) + cosine*cos(waves*actual)",
      "de Silva, Sensors and Actuators: Engineering System Instrumentation, 2nd edition, 2015 (encoder "
      "error: "
      "eccentricity)",
      {Place::sensor},
      {any("sine", "{position}", "amplitude of the sine"),
       any("cosine", "{position}", "amplitude of the cosine"),
       fixed("waves", "1", "waves per 2 pi of the measured position", 1.0, kSmallestPositive, kInfinity)},
      {},
      ""};
  return kDeclaration;
}

// A tenth of a millimetre on a disc of five centimetres, and a hundred times that.
Values EncoderEccentricity::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {0.1 * s.position, 0.1 * s.position, 1.0};
}

// Below a third of a turn a wave is an offset and a scale, which have names of their own.
std::vector<Values> EncoderEccentricity::starts(const Scales& /*scales*/) const {
  std::vector<Values> grid;
  for (const double waves : {1.0, 2.0}) {
    Values p = null_values();
    p[kWaves] = waves;
    grid.push_back(p);
  }
  return grid;
}

double EncoderEccentricity::reading(double actual, const double* p) const {
  const double angle = p[kWaves] * actual;
  return actual + p[kSine] * std::sin(angle) + p[kCosine] * std::cos(angle);
}

}  // namespace plumbline::effects
