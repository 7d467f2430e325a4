#include "validation/identify/inverse_model/inverse_model.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <set>

#include "simulator/model/plant.h"
#include "simulator/sensing/low_pass.h"
#include "simulator/trace/error.h"
#include "validation/identify/inverse_model/measured_motion.h"

namespace plumbline::validation {
namespace {

using measured::arrived_commands;
using measured::bounded;
using measured::differentiated;
using measured::Motion;
using measured::motor_map;
using measured::moving_motors;
using measured::no_inverse;
using measured::positions;
using measured::without_limits;

constexpr double kEdgePeriods = 2.0;  // of the force cutoff
constexpr double kFollows = 0.7;      // correlation from which one force follows another
constexpr double kFactor = 4.0;       // between two forces of one unit at most

/// Acceleration of the independent positions, and its slope with the moving motors' commands.
class Accelerations {
 public:
  Accelerations(model::Plant& plant, const std::vector<int>& moving, const Eigen::MatrixXd& commands)
      : plant_(plant), moving_(moving), x_(Eigen::VectorXd::Zero(plant.states())), rate_(plant.states()) {
    for (const int m : moving) {
      steps_.push_back(std::max(1e-3 * commands.row(m).cwiseAbs().maxCoeff(), 1e-9));
    }
  }

  /// Commands that give the acceleration a, in the order of the moving motors.
  Eigen::VectorXd needed(const Eigen::VectorXd& z, const Eigen::VectorXd& v, const Eigen::VectorXd& a,
                         const Eigen::VectorXd& command) {
    const auto n = static_cast<Eigen::Index>(moving_.size());
    x_.head(n) = z;
    x_.segment(n, n) = v;
    const Eigen::VectorXd given = at(command);
    Eigen::MatrixXd slope(n, n);
    Eigen::VectorXd u(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const auto step = steps_[static_cast<std::size_t>(i)];
      const int m = moving_[static_cast<std::size_t>(i)];
      Eigen::VectorXd moved = command;
      moved[m] += step;
      slope.col(i) = (at(moved) - given) / step;
      u[i] = command[m];
    }
    return u + slope.colPivHouseholderQr().solve(a - given);
  }

 private:
  Eigen::VectorXd at(const Eigen::VectorXd& command) {
    plant_.rate(x_.data(), command.data(), rate_.data());
    return rate_.segment(plant_.positions(), plant_.positions());
  }

  model::Plant& plant_;
  const std::vector<int>& moving_;
  std::vector<double> steps_;
  Eigen::VectorXd x_, rate_;
};

double correlation_of(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const double sizes = a.norm() * b.norm();
  return sizes > 0.0 ? a.dot(b) / sizes : 0.0;
}

double slope_of(const Eigen::VectorXd& needed, const Eigen::VectorXd& commanded) {
  const double size = commanded.squaredNorm();
  return size > 0.0 ? needed.dot(commanded) / size : 0.0;
}

CommandGain gain_of(const NeededForce& force) {
  CommandGain result;
  result.motor = force.motor;
  const Eigen::VectorXd needed = force.needed.array() - force.needed.mean();
  const Eigen::VectorXd commanded = force.recorded.array() - force.recorded.mean();
  result.gain = slope_of(needed, commanded);
  result.correlation = correlation_of(needed, commanded);
  const double speed = std::sqrt(force.velocity.squaredNorm() / static_cast<double>(force.velocity.size()));
  Eigen::MatrixXd friction(needed.size(), 4);
  friction.col(0).setOnes();
  friction.col(1) = force.position;
  friction.col(2) = force.velocity;
  // Smoothed over a small share of the usual speed: friction at a reversal is not a jump.
  friction.col(3) = (force.velocity / (0.02 * speed + 1e-300)).array().tanh();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(friction);
  const Eigen::VectorXd needed_core = needed - friction * qr.solve(needed);
  const Eigen::VectorXd commanded_core = commanded - friction * qr.solve(commanded);
  result.core_gain = slope_of(needed_core, commanded_core);
  result.core_correlation = correlation_of(needed_core, commanded_core);
  const Eigen::VectorXd acceleration = force.acceleration - friction * qr.solve(force.acceleration);
  const Eigen::VectorXd beyond = commanded_core - needed_core;
  const Eigen::VectorXd by_rotor = beyond - slope_of(beyond, acceleration) * acceleration;
  const Eigen::VectorXd by_factor = commanded_core - slope_of(commanded_core, needed_core) * needed_core;
  result.a_rotor_says_more = by_rotor.norm() < by_factor.norm();
  return result;
}

/// The unit in which the column of this command is declared.
std::string declared_unit(const model::Model& model, const Command& command) {
  return command.unit.empty() ? model.find_motor(command.motor)->command_unit : command.unit;
}

const Command* command_of(const Trial& trial, const std::string& motor) {
  const auto found = std::find_if(trial.commands.begin(), trial.commands.end(),
                                  [&](const Command& command) { return command.motor == motor; });
  return found == trial.commands.end() ? nullptr : &*found;
}

}  // namespace

double NeededForce::error_percent() const {
  const double size = recorded.norm();
  return size > 0.0 ? 100.0 * (recorded - needed).norm() / size : 0.0;
}

InverseModel inverse_model(const model::Model& model, const Trial& trial,
                           const InverseModelOptions& options) {
  InverseModel result;
  model::Plant plant(as_recorded(model, trial), trial.locks, trial.terrain);
  const Eigen::MatrixXd map = motor_map(plant);
  const std::vector<int> moving = moving_motors(map);
  result.not_available = no_inverse(plant, moving, trial);
  const double cutoff = bounded(options.force_cutoff, trial.period);
  const auto edge = static_cast<Eigen::Index>(std::ceil(kEdgePeriods / (cutoff * trial.period)));
  const Eigen::Index n = trial.samples();
  if (result.not_available.empty() && n < 4 * edge) {
    result.not_available = "the record is shorter than the filters' ends";
  }
  if (!result.not_available.empty()) {
    return result;
  }
  result.cutoff = cutoff;
  Eigen::MatrixXd z = positions(plant, trial, options.motion_cutoff);
  if (z.size() == 0) {
    result.not_available = "the sensors do not show every independent position";
    return result;
  }
  const Motion motion = differentiated(std::move(z), trial.period);
  const Eigen::MatrixXd recorded = arrived_commands(plant, trial);
  model::Plant unlimited(without_limits(model), trial.locks, trial.terrain);
  Accelerations accelerations(unlimited, moving, recorded);
  Eigen::MatrixXd needed(static_cast<Eigen::Index>(moving.size()), n);
  for (Eigen::Index k = 0; k < n; ++k) {
    needed.col(k) = accelerations.needed(motion.z.col(k), motion.v.col(k), motion.a.col(k), recorded.col(k));
  }
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const int m = moving[i];
    const double gain = plant.torque_gain(m);
    const model::Motor& motor = model.motors[static_cast<std::size_t>(m)];
    const auto filtered = [&](const Eigen::VectorXd& command) -> Eigen::VectorXd {
      return gain * sensing::low_pass(command, trial.period, cutoff).segment(edge, n - 2 * edge);
    };
    const auto of_motor = [&](const Eigen::MatrixXd& rows) -> Eigen::VectorXd {
      return (map.row(m) * rows).transpose().segment(edge, n - 2 * edge);
    };
    result.motors.push_back({motor.name, motor.angular ? "N m" : "N", filtered(recorded.row(m).transpose()),
                             filtered(needed.row(static_cast<Eigen::Index>(i)).transpose()),
                             of_motor(motion.z), of_motor(motion.v), of_motor(motion.a)});
  }
  return result;
}

std::vector<double> force_floors(const model::Model& model, const Trial& trial, const InverseModel& inverse,
                                 const InverseModelOptions& options) {
  if (inverse.motors.empty()) {
    return {};
  }
  constexpr unsigned kSeed = 1;  // any: the same answer twice
  std::mt19937_64 random(kSeed);
  std::normal_distribution<double> normal;
  Trial noisy = trial;
  for (Measured& channel : noisy.measured) {
    const model::Sensor* stated = model.find_sensor(channel.sensor);
    if (stated == nullptr) {
      continue;
    }
    model::Sensor sensor = *stated;
    sensor.resolution = channel.resolution.value_or(sensor.resolution);
    sensor.noise = channel.noise.value_or(sensor.noise);
    for (double& value : channel.values) {
      value += sensor.floor() * normal(random);
    }
  }
  const InverseModel moved = inverse_model(model, noisy, options);
  std::vector<double> floors;
  for (std::size_t m = 0; m < inverse.motors.size() && m < moved.motors.size(); ++m) {
    const Eigen::VectorXd change = moved.motors[m].needed - inverse.motors[m].needed;
    floors.push_back(std::sqrt(change.squaredNorm() / static_cast<double>(change.size())));
  }
  return floors;
}

bool CommandGain::follows() const {
  return core_correlation > kFollows && core_gain > 1.0 / kFactor && core_gain < kFactor;
}

bool CommandGain::implausible() const {
  if (gain > kFactor) {
    return correlation > kFollows;
  }
  return gain < 1.0 / kFactor && core_gain < 1.0 / kFactor && core_correlation > kFollows &&
         !(rotor_is_open && a_rotor_says_more);
}

std::vector<CommandGain> command_gains(const model::Model& model, const Trial& trial) {
  std::vector<CommandGain> gains;
  for (const NeededForce& force : inverse_model(model, trial, {}).motors) {
    gains.push_back(gain_of(force));
    gains.back().rotor_is_open = model.find_motor(force.motor)->rotor_inertia.uncertainty > 0.0;
  }
  return gains;
}

void check_command_units(const model::Model& model, const Trial& trial) {
  const std::vector<CommandGain> gains = command_gains(model, trial);
  std::set<std::string> right;
  for (const CommandGain& gain : gains) {
    const Command* command = command_of(trial, gain.motor);
    if (command != nullptr && gain.follows()) {
      right.insert(declared_unit(model, *command));
    }
  }
  for (const CommandGain& gain : gains) {
    const Command* command = command_of(trial, gain.motor);
    if (command == nullptr || !gain.implausible() || right.count(declared_unit(model, *command)) != 0) {
      continue;
    }
    char factor[32];
    std::snprintf(factor, sizeof factor, "%.3g", gain.factor());
    throw InputError({trial.file, 0, "commands." + gain.motor + ".column"},
                     "that the measured motion needs " + std::string(factor) +
                         " times the force of column \"" + command->column + "\" in " +
                         declared_unit(model, *command),
                     "about 1 times: the unit of this column is probably wrong (here, or as the motor's "
                     "command_unit in the model), or that of a measured position");
  }
}

}  // namespace plumbline::validation
