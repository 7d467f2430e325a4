// A Kalman filter of fixed size whose measurements' variances may change from sample to sample. No
// allocation.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "controllers/blocks/matrix.h"

namespace plumbline::controllers {

/// x+ = transition x + push, covariance P; measurements one after the other, each z = row x + noise.
template <int N>
class KalmanFilter {
 public:
  /// As if the state were `state` with the variances `variances`.
  void begin(const Matrix<N, 1>& state, const std::array<double, static_cast<std::size_t>(N)>& variances) {
    state_ = state;
    covariance_ = Matrix<N, N>::diagonal(variances);
  }
  const Matrix<N, 1>& state() const { return state_; }
  const Matrix<N, N>& covariance() const { return covariance_; }

  /// One sample on: `push` is what inputs add to the state, `noise` what the process noise adds to the
  /// covariance.
  void predict(const Matrix<N, N>& transition, const Matrix<N, 1>& push, const Matrix<N, N>& noise) {
    state_ = transition * state_ + push;
    covariance_ = transition * covariance_ * transition.transposed() + noise;
  }

  /// Takes in one number. Numbers with independent noise may be taken in one by one, in any order, with the
  /// same result as together. `row`: what the state makes of it; `variance`: of its noise, larger than 0.
  void correct(const Matrix<1, N>& row, double measured, double variance) {
    const Matrix<N, 1> spread = covariance_ * row.transposed();
    const double total = (row * spread)[0] + variance;
    const double surprise = measured - (row * state_)[0];
    const Matrix<N, 1> weight = (1.0 / total) * spread;
    state_ = state_ + surprise * weight;
    // Joseph's form stays symmetric and positive however small the variance is.
    const Matrix<N, N> rest = Matrix<N, N>::identity() - weight * row;
    covariance_ = rest * covariance_ * rest.transposed() + variance * (weight * weight.transposed());
  }

 private:
  Matrix<N, 1> state_;
  Matrix<N, N> covariance_;
};

}  // namespace plumbline::controllers
