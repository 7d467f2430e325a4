#include "simulator/effects/hysteresis.h"

#include <cmath>
#include <cstddef>

#include "simulator/effects/parameters.h"

namespace plumbline::effects {
namespace {

enum Index : std::size_t { kLoss, kRest, kSmoothingSpeed };

}  // namespace

const Declaration& Hysteresis::declaration() const {
  static const Declaration kDeclaration{
      "hysteresis",
      "hysteretic damping: a loss in each cycle that does not depend on frequency",
      "f = -loss*|x - rest|*tanh(v/smoothing_speed)",
      "Reid, Free vibration and hysteretic damping, J. Royal Aeronautical Society 60, 1956",
      {Place::coordinate},
      {non_negative("loss", "{force}/{position}", "friction force per deflection"), rest(),
       smoothing_speed()},
      {},
      ""};
  return kDeclaration;
}

Values Hysteresis::typical(const Scales& scales) const {
  const Scales s = guarded(scales);
  return {s.force / s.position, s.position, smoothing_speed_for(scales)};
}

std::vector<Values> Hysteresis::starts(const Scales& scales) const {
  Values p = null_values();
  p[kSmoothingSpeed] = smoothing_speed_for(scales);
  return starts_at_rests(p, kRest, scales, {-1.0, -0.3, 0.0, 0.3, 1.0});
}

bool Hysteresis::is_null(const double* p) const { return p[kLoss] == 0.0; }

double Hysteresis::force(const Motion& m, const double* /*state*/, const double* p) const {
  return -p[kLoss] * std::abs(m.position - p[kRest]) * smooth_sign(m.velocity, p[kSmoothingSpeed]);
}

void Hysteresis::switches(const Motion& m, const double* p, std::vector<double>& g) const {
  g.push_back(m.position - p[kRest]);  // kink of |x - rest|
}

}  // namespace plumbline::effects
