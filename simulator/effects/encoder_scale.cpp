#include "simulator/effects/encoder_scale.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kScale };

}  // namespace

const Declaration& EncoderScale::declaration() const {
  static const Declaration kDeclaration{
      "encoder_scale",
      "a sensor whose scale is wrong",
      "reading = scale*actual",
      "Hollerbach, Khalil and Gautier, Model Identification, in: Springer Handbook of Robotics, 2008",
      {Place::sensor},
      {Parameter{"scale", "1", "reading over true value", 1.0, 0.0, kInfinity, Scale::linear, false}},
      {},
      ""};
  return kDeclaration;
}

Values EncoderScale::typical(const Scales& /*scales*/) const { return {1.0}; }

std::vector<Values> EncoderScale::starts(const Scales& /*scales*/) const { return {null_values()}; }

double EncoderScale::reading(double actual, const double* p) const { return p[kScale] * actual; }

}  // namespace plumbline::effects
