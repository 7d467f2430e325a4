// Commands held over each sample, with each motor's own pure delay.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace plumbline::integrate {

/// Sample k holds on [t_k, t_k + period); a motor with delay d sees it on [t_k + d, t_k + period + d).
/// A delay that is not a whole number of samples breaks each sample in two: the breaks are where the
/// integrator must stop. Before the first sample holds what is said of it, or the first one.
class HeldCommands {
 public:
  /// samples: motors x N, in command units; delays: s, one for each motor; before: what held for ever before
  /// the first sample, of each motor; empty: the first sample's.
  HeldCommands(Eigen::MatrixXd samples, double period, const std::vector<double>& delays,
               Eigen::VectorXd before = {});

  /// Fractions of a period at which some command changes: sorted, the first is 0.
  const std::vector<double>& breaks() const { return breaks_; }
  /// Commands that hold from sample k + breaks()[b] on.
  void at(Eigen::Index k, std::size_t b, double* command) const;
  /// Mean over sample k, and its derivative with respect to each motor's delay (1/s).
  void mean(Eigen::Index k, double* command, double* slope) const;

  /// Commands that held before the first sample.
  void before(double* command) const;
  /// The command given at sample k, without delay.
  void held(Eigen::Index k, double* command) const;

  double period() const { return period_; }
  Eigen::Index motors() const { return samples_.rows(); }
  Eigen::Index samples() const { return samples_.cols(); }
  /// Closed loop: the command of sample k is now known.
  void set(Eigen::Index k, const double* command);
  /// Closed loop without an end: one sample further, the oldest one is dropped.
  void push(const double* command);
  /// Samples that matter at any time with these delays.
  static Eigen::Index depth(double period, const std::vector<double>& delays);

 private:
  double sample(Eigen::Index motor, Eigen::Index k) const;

  Eigen::MatrixXd samples_;
  Eigen::VectorXd before_;
  double period_;
  std::vector<Eigen::Index> whole_;
  std::vector<double> part_;
  std::vector<double> breaks_;
};

}  // namespace plumbline::integrate
