#include "controllers/atrias_running/estimator.h"

#include <algorithm>

namespace plumbline::controllers::atrias {
namespace {

constexpr double kRateKnown = 1e-4;  // m^2/s^2, of a robot that is released at rest

}  // namespace

void PointMassFilter::begin(double position, double rate, double acceleration, double rate_variance) {
  Matrix<3, 1> state;
  state[0] = position;
  state[1] = rate;
  state[2] = acceleration;
  const double drift = numbers_.force_noise / mass_;
  filter_.begin(state, {numbers_.loaded, rate_variance, drift * drift});
}

void PointMassFilter::restart(double position, double force) {
  force_ = force;
  begin(position, 0.0, force / mass_, kRateKnown);
}

void PointMassFilter::place(double position) {
  begin(position, rate(), acceleration(), std::max(filter_.covariance()(1, 1), kRateKnown));
}

void PointMassFilter::fly(double force) {
  force_ = force;
  begin(position(), rate(), force / mass_, std::max(filter_.covariance()(1, 1), kRateKnown));
}

void PointMassFilter::predict(double force) {
  Matrix<3, 3> transition = Matrix<3, 3>::identity();
  transition(0, 1) = transition(1, 2) = period_;
  Matrix<3, 1> push;
  push[2] = (force - force_) / mass_;
  const double drift = numbers_.force_noise / mass_;
  filter_.predict(transition, push, Matrix<3, 3>::diagonal({0.0, 0.0, drift * drift}));
  force_ = force;
}

void PointMassFilter::correct(double position, double load) {
  const double trust = std::clamp(load / numbers_.full_load, 0.0, 1.0);
  Matrix<1, 3> row;
  row(0, 0) = 1.0;
  filter_.correct(row, position, numbers_.unloaded - trust * (numbers_.unloaded - numbers_.loaded));
}

}  // namespace plumbline::controllers::atrias
