// A code disc that does not sit on its axis.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// reading = actual + sine sin(N actual) + cosine cos(N actual), N = waves     [rad]
/// waves: periods per 2 pi of what the sensor measures, times the turns that the disc makes meanwhile. One
/// wave a turn is a disc off its axis (of amplitude e/r, eccentricity over radius), two are an axis that is
/// not at right angles to it, or an oval ring. Source: de Silva, Sensors and Actuators (2nd edition, 2015),
/// section on encoder error (eccentricity).
class EncoderEccentricity final : public SensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double reading(double actual, const double* p) const override;
};

}  // namespace plumbline::effects
