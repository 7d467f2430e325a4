#include "simulator/effects/encoder_offset.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kOffset };

}  // namespace

const Declaration& EncoderOffset::declaration() const {
  static const Declaration kDeclaration{
      "encoder_offset",
      "a sensor whose zero is displaced",
      "reading = actual + offset",
      "Hollerbach, Khalil and Gautier, Model Identification, in: Springer Handbook of Robotics, 2008",
      {Place::sensor},
      {any("offset", "{position}", "reading at zero")},
      {},
      ""};
  return kDeclaration;
}

Values EncoderOffset::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position};
}

std::vector<Values> EncoderOffset::starts(const Scales& /*scales*/) const { return {null_values()}; }

double EncoderOffset::reading(double actual, const double* p) const { return actual + p[kOffset]; }

}  // namespace plumbline::effects
