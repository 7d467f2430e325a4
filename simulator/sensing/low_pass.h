// Low-pass filtering of recorded signals without phase shift.
#pragma once

#include <Eigen/Core>

namespace plumbline::sensing {

/// A Butterworth low-pass of fourth order, run forwards and then backwards over the record, so that it delays
/// nothing. Its gain, for both runs together, at frequency f with sample period T is
///   1 / (1 + (tan(pi f T) / tan(pi cutoff T))^8),
/// one half at the cutoff. The ends are continued by the record turned about its first (last) sample, so that
/// a straight line comes out unchanged.
/// Source: A. V. Oppenheim, R. W. Schafer, Discrete-Time Signal Processing, chapter 7 (Butterworth filters by
/// the bilinear transformation); F. Gustafsson, Determining the initial states in forward-backward
/// filtering, IEEE Trans. Signal Processing 44(4), 1996, on why the ends need care.
/// Throws std::invalid_argument when the cutoff (Hz) is not between 0 and half the sample rate, the period
/// (s) is not positive or there are fewer than 8 samples.
Eigen::VectorXd low_pass(const Eigen::VectorXd& signal, double period, double cutoff);

}  // namespace plumbline::sensing
