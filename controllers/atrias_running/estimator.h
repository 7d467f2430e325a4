// Where the centre of mass is and how fast, from the legs' geometry and the springs' forces. Wu (2017),
// section 5.6.1: two filters of the same structure, forward and upward.
#pragma once

#include "controllers/blocks/kalman.h"

namespace plumbline::controllers::atrias {

struct FilterNumbers {
  double force_noise = 50.0;  ///< N, of the estimated force from sample to sample
  double loaded = 1.25e-4;    ///< m^2, variance of the distance from a loaded foot
  double unloaded = 1.0;      ///< m^2, of one without load
  double full_load = 0.1;     ///< load above which a foot counts as loaded, in weights
};

/// A point mass under a force: position, its rate and its acceleration. The acceleration changes with the
/// force and drifts by noise, so that a force that is wrong by a constant is found out.
class PointMassFilter {
 public:
  PointMassFilter(double period, double mass, const FilterNumbers& numbers)
      : period_(period), mass_(mass), numbers_(numbers) {}

  /// As just released: at rest, under `force` (N).
  void restart(double position, double force);
  /// A new point to measure from, as at a touchdown: rate and its uncertainty stay.
  void place(double position);
  /// Without contact the force is known: the acceleration is force/mass.
  void fly(double force);
  /// One sample on, under `force` (N) at the end of it.
  void predict(double force);
  /// Takes in a distance (m) from a foot that carries `load` weights.
  void correct(double position, double load);

  double position() const { return filter_.state()[0]; }
  double rate() const { return filter_.state()[1]; }
  double acceleration() const { return filter_.state()[2]; }

 private:
  void begin(double position, double rate, double acceleration, double rate_variance);

  double period_, mass_;
  FilterNumbers numbers_;
  KalmanFilter<3> filter_;
  double force_ = 0.0;
};

}  // namespace plumbline::controllers::atrias
