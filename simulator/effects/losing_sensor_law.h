// A sensor that loses something of what it counts.
#pragma once

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// A sensor that adds up increments and misses some of them: its one state is what it has missed so far,
/// which the reading has beside the true value until the record ends. It is 0 where a record begins. What is
/// missed follows the true motion and acts nowhere back on it.
class LosingSensorLaw : public SensorLaw {
 public:
  /// d(state)/dt at the true rate of what is measured.
  virtual double loss_rate(double actual_rate, const double* p) const = 0;
  /// While nothing was lost.
  double reading(double actual, const double* /*p*/) const final { return actual; }
};

}  // namespace plumbline::effects
