#include "validation/identify/standard/needed_torques.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "simulator/model/positions_from.h"
#include "simulator/sensing/low_pass.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {
namespace {

constexpr double kEdgePeriods = 2.0;  // of the force cutoff

[[noreturn]] void refuse(const Trial& trial, const std::string& why) {
  throw InputError(
      {trial.file, 0, "--standard"}, why,
      "measured positions of everything that moves, and recorded commands of all motors that can move");
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

/// What of the recorded torque the model delivers, by moving place: sums of the force that the commands make
/// times the recorded torque, and of the recorded torque's square, over the same samples.
struct Delivered {
  Eigen::VectorXd made, recorded;

  /// The slope of what is made over what was recorded; 1 where no torque was recorded.
  double share(Eigen::Index place) const {
    return recorded[place] > 0.0 ? std::abs(made[place] / recorded[place]) : 1.0;
  }
};

/// Rows of W and the places that they stand for: moving motors, then joints that no motor moves.
struct Places {
  std::vector<int> places;
  Eigen::MatrixXd W;
};

Places places_of(const model::Model& model, const Trial& trial, const model::Plant& plant) {
  const Eigen::MatrixXd motors = measured::motor_map(plant);
  Places found{measured::moving_motors(motors), {}};
  found.W = motors(found.places, Eigen::all);
  for (std::size_t c = 0; c < model.coordinates.size() && found.W.rows() < plant.positions(); ++c) {
    const std::string& name = model.coordinates[c].name;
    if (floats(model, name)) {
      refuse(trial, "a floating base, which no motor holds");
    }
    Eigen::MatrixXd more(found.W.rows() + 1, plant.positions());
    more.row(found.W.rows()) = model::observe_place(plant, name, 1.0).row;
    more.topRows(found.W.rows()) = found.W;
    if (Eigen::FullPivLU<Eigen::MatrixXd>(more).rank() == more.rows()) {
      found.W = more;
      found.places.push_back(static_cast<int>(model.motors.size() + c));
    }
  }
  return found;
}

Eigen::MatrixXd filtered(const Eigen::MatrixXd& rows, const MotionSamples& samples) {
  Eigen::MatrixXd result(rows.rows(), static_cast<Eigen::Index>(samples.used.size()));
  for (Eigen::Index r = 0; r < rows.rows(); ++r) {
    const Eigen::VectorXd low = sensing::low_pass(rows.row(r).transpose(), samples.period, samples.cutoff);
    result.row(r) = low(samples.used).transpose();
  }
  return result;
}

/// Every so many samples of the signals, without what would fold below the cutoff.
void thin(MotionSamples& samples) {
  constexpr double kPerPeriod = 8.0;
  constexpr double kFolding = 3.0;
  const double T = samples.trial->period;
  const auto stride = static_cast<Eigen::Index>(1.0 / (kPerPeriod * samples.cutoff * T));
  samples.period = T;
  if (stride < 2) {
    return;
  }
  const double cutoff = measured::bounded(kFolding * samples.cutoff, T);
  for (Eigen::MatrixXd* rows : {&samples.motion.z, &samples.motion.v, &samples.motion.a, &samples.commands}) {
    Eigen::MatrixXd some(rows->rows(), (rows->cols() + stride - 1) / stride);
    for (Eigen::Index r = 0; r < rows->rows(); ++r) {
      const Eigen::VectorXd low = sensing::low_pass(rows->row(r).transpose(), T, cutoff);
      for (Eigen::Index k = 0; k < some.cols(); ++k) {
        some(r, k) = low[k * stride];
      }
    }
    *rows = std::move(some);
  }
  std::vector<Eigen::Index> used;
  for (const Eigen::Index k : samples.used) {
    if (k % stride == 0) {
      used.push_back(k / stride);
    }
  }
  samples.used = std::move(used);
  samples.period = static_cast<double>(stride) * T;
}

}  // namespace

const std::string& place_name(const model::Model& model, int place) {
  const auto index = static_cast<std::size_t>(place);
  return index < model.motors.size() ? model.motors[index].name
                                     : model.coordinates[index - model.motors.size()].name;
}

bool is_passive(const model::Model& model, int place) {
  return static_cast<std::size_t>(place) >= model.motors.size();
}

int place_index(const model::Model& model, const std::string& name) {
  const int motor = model.motor_index(name);
  if (motor >= 0) {
    return motor;
  }
  const auto found = std::find_if(model.coordinates.begin(), model.coordinates.end(),
                                  [&](const model::Coordinate& one) { return one.name == name; });
  return static_cast<int>(model.motors.size()) + static_cast<int>(found - model.coordinates.begin());
}

bool place_is_angular(const model::Model& model, int place) {
  const auto index = static_cast<std::size_t>(place);
  return index < model.motors.size() ? model.motors[index].angular
                                     : model.coordinates[index - model.motors.size()].angular;
}

bool floats(const model::Model& model, const std::string& name) {
  const auto& joints = model.skeleton.joints;
  return std::any_of(joints.begin(), joints.end(),
                     [&](const model::Joint& joint) { return joint.floats && joint.name == name; });
}

Eigen::VectorXd mean_over_motion(const model::Model& model, const MotionSamples& samples,
                                 const std::function<Eigen::VectorXd(const Eigen::MatrixXd&)>& of) {
  constexpr std::size_t kLooks = 10;
  const Trial& trial = *samples.trial;
  model::Plant plant(as_recorded(model, trial), trial.locks, trial.terrain);
  const Eigen::Index n = plant.positions();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  Eigen::VectorXd rate = x;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(n);
  for (std::size_t i = 0; i < kLooks; ++i) {
    const Eigen::Index k = samples.used[i * (samples.used.size() - 1) / (kLooks - 1)];
    x.head(n) = samples.motion.z.col(k);
    const Eigen::VectorXd command = samples.commands.col(k);
    plant.rate(x.data(), command.data(), rate.data());
    sum += of(plant.mass_matrix());
  }
  return sum / static_cast<double>(kLooks);
}

MotionSamples motion_samples(const model::Model& model, const Trial& trial, double motion_cutoff,
                             double force_cutoff) {
  MotionSamples samples;
  samples.trial = &trial;
  model::Plant plant(as_recorded(model, trial), trial.locks, trial.terrain);
  if (plant.meets_ground()) {
    refuse(trial, "feet on the ground, whose forces no motor makes");
  }
  if (plant.link_points() > 0) {
    refuse(trial, "links in contact with each other, whose forces no motor makes");
  }
  const Places places = places_of(model, trial, plant);
  samples.moving = places.places;
  const std::string reason = measured::no_inverse(plant, samples.moving, trial);
  if (!reason.empty()) {
    refuse(trial, reason);
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(places.W.transpose());
  if (!lu.isInvertible()) {
    refuse(trial, "motors that all move together");
  }
  samples.to_places = lu.inverse();
  samples.cutoff = measured::bounded(force_cutoff, trial.period);
  const auto edge = static_cast<Eigen::Index>(std::ceil(kEdgePeriods / (samples.cutoff * trial.period)));
  samples.used = away_from_ends(trial, edge);
  if (samples.used.empty()) {
    return samples;
  }
  Eigen::MatrixXd z = measured::positions(plant, trial, motion_cutoff);
  if (z.size() == 0) {
    refuse(trial, "sensors that do not show every independent position");
  }
  samples.motion = measured::differentiated(std::move(z), trial.period);
  samples.commands = means(measured::arrived_commands(plant, trial));
  thin(samples);
  samples.inertia = mean_over_motion(model, samples, [&](const Eigen::MatrixXd& M) {
    return Eigen::VectorXd((samples.to_places * M * samples.to_places.transpose()).diagonal());
  });
  return samples;
}

Eigen::MatrixXd torque_errors(const model::Model& model, const MotionSamples& samples) {
  constexpr Eigen::Index kLooks = 8;  // one sample of so many says how much of the torque is delivered
  const Trial& trial = *samples.trial;
  model::Plant plant(of_trial(model, trial), trial.locks, trial.terrain);
  const Eigen::Index n = plant.positions();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  Eigen::VectorXd rate = x;
  Eigen::VectorXd idle = x;
  Eigen::MatrixXd errors(n, samples.commands.cols());
  Delivered delivered{Eigen::VectorXd::Zero(n), Eigen::VectorXd::Zero(n)};
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(samples.commands.rows());
  for (Eigen::Index k = 0; k < errors.cols(); ++k) {
    x.head(n) = samples.motion.z.col(k);
    x.segment(n, n) = samples.motion.v.col(k);
    const Eigen::VectorXd command = samples.commands.col(k);
    plant.rate(x.data(), command.data(), rate.data());
    const Eigen::MatrixXd& M = plant.mass_matrix();
    errors.col(k) = samples.to_places * (M * (samples.motion.a.col(k) - rate.segment(n, n)));
    for (Eigen::Index i = 0; i < n; ++i) {
      if (is_passive(model, samples.moving[static_cast<std::size_t>(i)])) {
        errors(i, k) *=
            samples.inertia[i] / samples.to_places.row(i).dot(M * samples.to_places.row(i).transpose());
      }
    }
    if (k % kLooks == 0) {
      plant.rate(x.data(), none.data(), idle.data());
      const Eigen::VectorXd force = samples.to_places * (M * (rate - idle).segment(n, n));
      for (Eigen::Index i = 0; i < n; ++i) {
        const int place = samples.moving[static_cast<std::size_t>(i)];
        const double torque = is_passive(model, place) ? 0.0 : plant.torque_gain(place) * command[place];
        delivered.made[i] += force[i] * torque;
        delivered.recorded[i] += torque * torque;
      }
    }
  }
  for (Eigen::Index i = 0; i < n; ++i) {
    errors.row(i) /= delivered.share(i);
  }
  return filtered(errors, samples);
}

Eigen::MatrixXd recorded_torques(const model::Model& model, const MotionSamples& samples) {
  const model::Plant plant(model, samples.trial->locks, samples.trial->terrain);
  Eigen::MatrixXd torques =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(samples.moving.size()), samples.commands.cols());
  for (Eigen::Index i = 0; i < torques.rows(); ++i) {
    const int place = samples.moving[static_cast<std::size_t>(i)];
    if (!is_passive(model, place)) {
      torques.row(i) = plant.torque_gain(place) * samples.commands.row(place);
    }
  }
  return filtered(torques, samples);
}

}  // namespace plumbline::validation
