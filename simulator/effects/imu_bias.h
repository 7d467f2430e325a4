// An inertial sensor whose zero is displaced.
#pragma once

#include <vector>

#include "simulator/effects/inertial_sensor_law.h"

namespace plumbline::effects {

/// reading = actual + (x, y, z)                    [rad/s of a gyroscope, m/s^2 of an accelerometer]
/// The turn-on bias of each axis, constant over a record: it drifts with temperature over minutes. Any value;
/// null at 0. A sensor has no power.
/// Source: Titterton and Weston, Strapdown Inertial Navigation Technology (2nd edition, 2004), chapter 8
/// (calibration and compensation); Tedaldi, Pretto and Menegatti, IEEE Int. Conf. Robotics and Automation
/// (2014), section III.
class ImuBias final : public InertialSensorLaw {
 public:
  const Declaration& declaration() const override;
  Values typical(const Scales& scales) const override;
  std::vector<Values> starts(const Scales& scales) const override;

  InertialReading inertial_reading(const double* p) const override;
};

}  // namespace plumbline::effects
