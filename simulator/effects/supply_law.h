// What all motors of a robot hang on.
#pragma once

#include "simulator/effects/law.h"

namespace plumbline::effects {

/// The share of its torque that is left to every motor, by what all of them take from one supply. It acts
/// behind the laws of each motor; a motor alone does not know of the others, so torque() passes on.
class SupplyLaw : public ActuatorLaw {
 public:
  /// `torques` that the motors would give of a full supply [N m or N] and their `speeds` [rad/s or m/s],
  /// `motors` of each. Share 1: nothing is missing.
  virtual double share(const double* torques, const double* speeds, int motors, const double* p) const = 0;
  double torque(double commanded, const double* /*state*/, const double* /*p*/) const final {
    return commanded;
  }
};

}  // namespace plumbline::effects
