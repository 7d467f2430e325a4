// The motion of a trial as a model predicts it and as it was measured, position by position.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "validation/identify/predict/problem.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

struct TrialMotionOptions {
  double window = 0.5;             ///< s; 0: the whole recording in one piece
  const StopFlag* stop = nullptr;  ///< raised: Stopped is thrown
};

/// Positions are those of the Plant of model and trial.locks, positions x samples.
struct TrialMotion {
  Eigen::VectorXd time;       ///< s
  Eigen::MatrixXd predicted;  ///< each window from the state that its first samples show
  Eigen::MatrixXd measured;   ///< nearest to all measured channels; a stretch that none sees is zero
  std::vector<Eigen::Matrix3Xd> foot_forces;  ///< predicted, of the ground on each foot, N
};

/// Throws InputError when the trial is shorter than one window, std::runtime_error when the integrator fails.
TrialMotion trial_motion(const model::Model& model, const Trial& trial, const TrialMotionOptions& options);

}  // namespace plumbline::validation
