// How a motion's deviations grow over one piece of it.
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <utility>

namespace plumbline::validation {

/// S = d(state)/d(initial state, parameters), carried along S' = A S + [0 B] over a piece of length h with A
/// and B of its middle, B in the last columns:
///   S <- D^-1 (N S + h P B), with Z = hA
///   D = I - 3/5 Z + 3/20 Z^2 - 1/60 Z^3,  N = I + 2/5 Z + 1/20 Z^2,  P = Z^-1 (N - D) = I - 1/10 Z + 1/60
///   Z^2,
/// Pade's (2,3) approximation of the exponential (Hairer and Wanner, Solving ODEs II, IV.3): what a stiff law
/// damps vanishes (L-stable), fifth order in Z, one linearisation for each piece. It vanishes as 3/|Z| only,
/// where exp(Z) is long nothing: with `parts` steps over the piece, as (3 parts/|Z|)^parts.
class Sensitivity {
 public:
  explicit Sensitivity(Eigen::MatrixXd start) : S_(std::move(start)) {}

  Eigen::MatrixXd& S() { return S_; }
  const Eigen::MatrixXd& before() const { return before_; }
  void step(double h, const Eigen::MatrixXd& A, const Eigen::MatrixXd& B, int parts = 1);
  /// Mean of S over the last piece, which holds A (h mean) = S - before - h B as the step does; of each part
  ///   D^-1 (P S_before + h Q B),  Q = Z^-1 (P - D) = 1/2 I - 2/15 Z + 1/60 Z^2.
  Eigen::MatrixXd mean() const;

 private:
  void take_part();

  Eigen::MatrixXd S_, before_, Z_, square_, right_, D_, hB_;
  Eigen::MatrixXd begins_;  // mean of S where the parts begin
  Eigen::PartialPivLU<Eigen::MatrixXd> factor_;
};

}  // namespace plumbline::validation
