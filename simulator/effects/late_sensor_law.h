// A sensor that is late.
#pragma once

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// What a sensor shows of a motion is what it was `lag` seconds earlier, to first order: the lags of a
/// channel's laws add up and act before what its other laws make of the true value.
class LateSensorLaw : public SensorLaw {
 public:
  virtual double lag(const double* p) const = 0;  ///< s
  /// At rest nothing is late.
  double reading(double actual, const double* /*p*/) const final { return actual; }
};

}  // namespace plumbline::effects
