// A sensor whose zero is displaced.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// reading = actual + offset                       [rad or m]
/// Source: Hollerbach, Khalil and Gautier, Springer Handbook of Robotics (2008), chapter Model
/// Identification.
class EncoderOffset final : public SensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double reading(double actual, const double* p) const override;
};

}  // namespace plumbline::effects
