// A sensor whose scale is wrong.
#pragma once

#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// reading = scale actual                          [rad or m]; null at scale = 1
/// Source: Hollerbach, Khalil and Gautier, Springer Handbook of Robotics (2008), chapter Model
/// Identification.
class EncoderScale final : public SensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  double reading(double actual, const double* p) const override;
};

}  // namespace plumbline::effects
