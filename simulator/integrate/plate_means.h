// What a sampled force plate shows: the mean force over the sample that ends.
#pragma once

#include <Eigen/Core>

#include "simulator/model/plant.h"

namespace plumbline::integrate {

/// (1/T) integral of the vertical force over the time since begin(), by the trapezoidal rule over the states
/// that are added: a plate's amplifier takes away what is faster than its samples, so that an impact shorter
/// than one is seen by its impulse, whenever in the sample it comes. Nothing without a force plate.
class PlateMeans {
 public:
  explicit PlateMeans(model::Plant& plant);

  bool any() const { return any_; }
  void begin(double time, const double* x);
  void add(double time, const double* x);
  /// Replaces the plates' readings in y, in N; after begin() alone they stay.
  void write(double* y) const;

 private:
  model::Plant& plant_;
  bool any_;
  double begin_ = 0.0, last_ = 0.0;
  Eigen::VectorXd force_, next_, impulse_;
};

}  // namespace plumbline::integrate
