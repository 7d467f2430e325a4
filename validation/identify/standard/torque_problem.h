// The least squares of torque errors: from a model and its train trials to better values.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "validation/identify/predict/problem.h"
#include "validation/identify/standard/free_values.h"
#include "validation/identify/standard/needed_torques.h"

namespace plumbline::validation {

/// Frequencies above half the sample rate are brought down to 0.4 times the sample rate.
struct Cutoffs {
  double motion = 100.0;  ///< Hz: low-pass of the measured positions before they are differentiated
  double force = 40.0;    ///< Hz: low-pass of torques and regressor
};

/// By trial: moving motors x used samples.
using TorqueErrors = std::vector<Eigen::MatrixXd>;

/// By block of a trial's samples: the errors of one block are correlated, and only blocks are independent.
struct TorqueBlocks {
  Eigen::MatrixXd squares;  ///< motors, then coordinates of the model x blocks: sums of squared errors
  Eigen::MatrixXd samples;  ///< likewise: how many
};

/// By value, for one spread each.
using TorqueSlopes = std::vector<TorqueErrors>;

/// With e_m(t) of torque_errors() and N_m independent samples of motor m (a share 2 f T of them, f the force
/// cutoff and T the sample period), the values theta minimise within their limits
///   sum_m N_m log(mean of e_m^2) + sum over known values ((theta_i - stated_i) / spread_i)^2,
/// minus twice the logarithm of the likelihood of noise of unknown size in each torque and of what is stated.
/// e is affine in all values but for the products of masses and shifts of their centres.
class TorqueProblem {
 public:
  /// Throws InputError as motion_samples() does, and where no trial has the role.
  TorqueProblem(const model::Model& model, const Data& data, const Cutoffs& cutoffs, Role role = Role::train);

  const std::map<std::string, MotorScales>& scales() const { return scales_; }
  double cutoff() const { return all_.front().cutoff; }
  Eigen::Index samples() const;
  double independent_samples() const;  ///< of all motors

  /// Root mean square of each moving motor's torque error.
  std::map<int, double> rms(const model::Model& model) const;
  double cost(const FreeModel& free) const;
  TorqueBlocks blocks(const model::Model& model, double length) const;  ///< of about `length` s
  double independent_share() const { return share_; }                   ///< of the samples

  TorqueErrors errors(const model::Model& model) const;
  /// Of the values from index `first` on, at those that `free` has.
  TorqueSlopes slopes(const FreeModel& free, std::size_t first, const TorqueErrors& errors) const;

  /// One step of Gauss-Newton with these slopes, weights to their end, shortened until the cost falls. Zero:
  /// no step made it fall; else by how much it fell.
  double step(FreeModel& free, const TorqueErrors& errors, const TorqueSlopes& slopes) const;
  /// Steps with fresh slopes of all values until they bring less than a tenth of a standard deviation.
  void search(FreeModel& free) const;

 private:
  FreeModel aimed(FreeModel free, const TorqueErrors& errors, const TorqueSlopes& slopes) const;

  std::vector<MotionSamples> all_;
  std::map<std::string, MotorScales> scales_;
  std::map<int, double> least_;  ///< below which no error is held for noise
  int threads_;
  double share_ = 1.0;  ///< of the samples that is independent
};

}  // namespace plumbline::validation
