#include "simulator/effects/sensor_lag.h"

#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kLag };

}  // namespace

const Declaration& SensorLag::declaration() const {
  static const Declaration kDeclaration{
      "sensor_lag",
      "a channel that is late: a filter, a bus, another clock",
      "reading = actual - lag*actual_rate",
      "Oppenheim and Schafer, Discrete-Time Signal Processing, 3rd edition, 2010, section 5.1.1 (group "
      "delay)",
      {Place::sensor},
      {any("lag", "s", "by which the channel is late; negative: ahead of the others")},
      {},
      ""};
  return kDeclaration;
}

Values SensorLag::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.position / s.velocity};
}

std::vector<Values> SensorLag::starts(const Scales& /*scales*/) const { return {null_values()}; }

double SensorLag::lag(const double* p) const { return p[kLag]; }

}  // namespace plumbline::effects
