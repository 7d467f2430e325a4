#include "validation/standard/needed_torques.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "simulator/sensing/low_pass.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

constexpr double kEdgePeriods = 2.0;  // of the force cutoff

[[noreturn]] void refuse(const Trial& trial, const std::string& why) {
  throw InputError(
      {trial.file, 0, "--standard"}, why,
      "measured positions of everything that moves, and one motor with a recorded command for each");
}

model::Model of_trial(const model::Model& model, const Trial& trial) {
  return measured::without_limits(as_recorded(model, trial));
}

std::vector<Eigen::Index> away_from_ends(const Trial& trial, Eigen::Index edge) {
  std::vector<Eigen::Index> used;
  for (const Stretch& stretch : stretches_of(trial)) {
    for (Eigen::Index k = stretch.first + edge; k < stretch.end - edge; ++k) {
      used.push_back(k);
    }
  }
  return used;
}

/// Mean of what is held before and after each sample.
Eigen::MatrixXd means(const Eigen::MatrixXd& held) {
  Eigen::MatrixXd result = held;
  const Eigen::Index n = held.cols() - 1;
  result.rightCols(n) = 0.5 * (held.rightCols(n) + held.leftCols(n));
  return result;
}

double torque_scale(const model::Model& model, const std::string& motor) {
  double scale = 1.0;
  for (const model::EffectUse& use : model.effects) {
    if (use.at == motor && use.law->declaration().name == "torque_constant_error") {
      scale *= use.values.front().value;
    }
  }
  return scale;
}

Eigen::MatrixXd filtered(const Eigen::MatrixXd& rows, const MotionSamples& samples) {
  Eigen::MatrixXd result(rows.rows(), static_cast<Eigen::Index>(samples.used.size()));
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const Eigen::VectorXd low =
        sensing::low_pass(rows.row(r).transpose(), samples.trial->period, samples.cutoff);
    result.row(r) = low(samples.used).transpose();
  }
  return result;
}

}  // namespace

MotionSamples motion_samples(const model::Model& model, const Trial& trial, double motion_cutoff,
                             double force_cutoff) {
  MotionSamples samples;
  samples.trial = &trial;
  model::Plant plant(as_recorded(model, trial), trial.locks, trial.terrain);
  const Eigen::MatrixXd map = measured::motor_map(plant);
  samples.moving = measured::moving_motors(map);
  const std::string reason = measured::no_inverse(plant, samples.moving, trial);
  if (!reason.empty()) {
    refuse(trial, reason);
  }
  if (plant.meets_ground()) {
    refuse(trial, "feet on the ground, whose forces no motor makes");
  }
  const Eigen::MatrixXd W = map(samples.moving, Eigen::all);
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(W.transpose());
  if (!lu.isInvertible()) {
    refuse(trial, "motors that all move together");
  }
  samples.to_motors = lu.inverse();
  samples.cutoff = measured::bounded(force_cutoff, trial.period);
  const auto edge = static_cast<Eigen::Index>(std::ceil(kEdgePeriods / (samples.cutoff * trial.period)));
  samples.used = away_from_ends(trial, edge);
  if (samples.used.empty()) {
    refuse(trial, "a record shorter than the filters' ends");
  }
  Eigen::MatrixXd z = measured::positions(plant, trial, motion_cutoff);
  if (z.size() == 0) {
    refuse(trial, "sensors that do not show every independent position");
  }
  samples.motion = measured::differentiated(std::move(z), trial.period);
  samples.commands = means(measured::arrived_commands(plant, trial));
  return samples;
}

Eigen::MatrixXd torque_errors(const model::Model& model, const MotionSamples& samples) {
  const Trial& trial = *samples.trial;
  model::Plant plant(of_trial(model, trial), trial.locks, trial.terrain);
  const Eigen::Index n = plant.positions();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  Eigen::VectorXd rate = x;
  Eigen::MatrixXd errors(n, trial.samples());
  for (Eigen::Index k = 0; k < trial.samples(); ++k) {
    x.head(n) = samples.motion.z.col(k);
    x.segment(n, n) = samples.motion.v.col(k);
    const Eigen::VectorXd command = samples.commands.col(k);
    plant.rate(x.data(), command.data(), rate.data());
    errors.col(k) =
        samples.to_motors * (plant.mass_matrix() * (samples.motion.a.col(k) - rate.segment(n, n)));
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    const int motor = samples.moving[static_cast<std::size_t>(i)];
    errors.row(i) /= torque_scale(model, model.motors[static_cast<std::size_t>(motor)].name);
  }
  return filtered(errors, samples);
}

Eigen::MatrixXd recorded_torques(const model::Model& model, const MotionSamples& samples) {
  const model::Plant plant(model, samples.trial->locks, samples.trial->terrain);
  Eigen::MatrixXd torques = samples.commands(samples.moving, Eigen::all);
  for (Eigen::Index i = 0; i < torques.rows(); ++i) {
    torques.row(i) *= plant.torque_gain(samples.moving[static_cast<std::size_t>(i)]);
  }
  return filtered(torques, samples);
}

}  // namespace plumbline::validation
