#include "simulator/effects/torque_saturation.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kSag };

}  // namespace

const Declaration& TorqueSaturation::declaration() const {
  static const Declaration kDeclaration{
      "torque_saturation",
      "a torque constant that sags with the current",
      "torque = u/sqrt(1 + sag*u^2)",
      "Fitzgerald, Kingsley and Umans, Electric Machinery, 6th edition, 2003, section 1.3 (magnetisation "
      "curves)",
      {Place::motor},
      {non_negative("sag", "1/({force})^2", "one over the square of the torque at which the iron saturates")},
      {},
      ""};
  return kDeclaration;
}

Values TorqueSaturation::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {1.0 / (s.force * s.force)};
}

std::vector<Values> TorqueSaturation::starts(const Scales& /*scales*/) const { return {null_values()}; }

double TorqueSaturation::torque(double commanded, const double* /*state*/, const double* p) const {
  return commanded / std::sqrt(1.0 + p[kSag] * commanded * commanded);
}

}  // namespace plumbline::effects
