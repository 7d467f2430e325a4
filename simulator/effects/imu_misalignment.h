// An inertial sensor whose axes are turned against their stated mounting.
#pragma once

#include <vector>

#include "simulator/effects/inertial_sensor_law.h"

namespace plumbline::effects {

/// reading = exp(-[r]) actual,  r = (x, y, z)      [rad/s of a gyroscope, m/s^2 of an accelerometer]
/// The sensor's axes are the stated ones turned by the rotation vector r, in the stated axes: R_BS exp([r])
/// in the place of R_BS. |r| at most pi; null at 0. All axes turn alike: of axes that are not at right angles
/// to each other only what is a turn is in it. A sensor has no power. Source: Titterton and Weston, Strapdown
/// Inertial Navigation Technology (2nd edition, 2004), chapter 8 (calibration and compensation) and
/// section 3.6 (direction cosine matrix of a rotation vector).
class ImuMisalignment final : public InertialSensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  InertialReading inertial_reading(const double* p) const override;
};

}  // namespace plumbline::effects
