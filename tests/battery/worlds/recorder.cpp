#include "tests/battery/worlds/recorder.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "tests/battery/worlds/mujoco_rig.h"
#include "tests/battery/worlds/outside.h"

namespace plumbline::battery::worlds {
namespace {

using validation::Experiment;
using validation::Trial;

/// Links' coordinates at the experiment's start; those that it does not name are 0.
Vector start_of(const Rig& rig, const Experiment& experiment) {
  Vector p = Vector::Zero(rig.coordinates);
  for (const validation::Start& start : experiment.start) {
    const Place* place = rig.place(start.coordinate);
    if (place == nullptr || place->row.cwiseAbs().sum() != 1.0) {
      throw std::invalid_argument("no foreign world starts at " + start.coordinate);
    }
    Eigen::Index k = 0;
    place->row.maxCoeff(&k);
    p[k] = start.position;
  }
  return p;
}

int index_of(const Rig& rig, const std::string& sensor) {
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    if (rig.sensors[s].name == sensor) return static_cast<int>(s);
  }
  throw std::invalid_argument("the rig has no sensor " + sensor);
}

/// u = kv (kp (r - y) - dy/dt), limited, from counts; dy/dt over so many samples (Janot and Brunot's
/// cascade).
class Cascade {
 public:
  Cascade(const validation::Controller& law, const Rig& rig, double period)
      : law_(law), sensor_(index_of(rig, law.sensor)), period_(period) {}
  double command(Eigen::Index k, double y) {
    const std::size_t over = static_cast<std::size_t>(law_.velocity_over);
    if (past_.empty()) {
      past_.assign(over, y);
    }
    const double rate = (y - past_.front()) / (static_cast<double>(over) * period_);
    past_.erase(past_.begin());
    past_.push_back(y);
    double u = law_.velocity_gain * (law_.position_gain * (law_.reference[k] - y) - rate);
    u += law_.disturbance.size() > 0 ? law_.disturbance[k] : 0.0;
    return law_.command_limit > 0.0 ? std::clamp(u, -law_.command_limit, law_.command_limit) : u;
  }
  int sensor() const { return sensor_; }
  const std::string& motor() const { return law_.motor; }

 private:
  validation::Controller law_;
  int sensor_;
  double period_;
  std::vector<double> past_;
};

}  // namespace

double counted(const Sensor& sensor, double value, std::mt19937_64& noise) {
  if (sensor.noise > 0.0) {
    value += std::normal_distribution<double>(0.0, sensor.noise)(noise);
  }
  return sensor.resolution > 0.0 ? sensor.resolution * std::round(value / sensor.resolution) : value;
}

namespace {

/// All positions at `at` samples (Hermite's cubic); before the first one as if it had gone on like that.
Vector positions_between(const Motion& motion, double at, double period) {
  const auto last = motion.positions.cols() - 1;
  if (at <= 0.0 || last < 1) {
    return motion.positions.col(0) + at * period * motion.rates.col(0);
  }
  const auto j = std::min(static_cast<Eigen::Index>(std::floor(at)), last - 1);
  const double t = at - static_cast<double>(j);
  const Vector p0 = motion.positions.col(j);
  const Vector p1 = motion.positions.col(j + 1);
  const Vector v0 = period * motion.rates.col(j);
  const Vector v1 = period * motion.rates.col(j + 1);
  return p0 + t * v0 + t * t * (3.0 * (p1 - p0) - 2.0 * v0 - v1) + t * t * t * (v0 + v1 - 2.0 * (p1 - p0));
}

// A counter that cannot follow misses a share of the way from one sample to the next, all or nothing of it:
// no speeds over which it begins to.
double missed_until(const Sensor& sensor, std::size_t index, const Rig& rig, const Motion& motion,
                    Eigen::Index k, double period) {
  const auto i = static_cast<Eigen::Index>(index);
  double missed = 0.0;
  double before = readings_of(rig, motion.positions.col(0))[i];
  for (Eigen::Index j = 1; j <= k; ++j) {
    const double now = readings_of(rig, motion.positions.col(j))[i];
    missed += std::abs(now - before) > sensor.limit_speed * period ? sensor.lost_share * (now - before) : 0.0;
    before = now;
  }
  return missed;
}

}  // namespace

Eigen::VectorXd readings_at(const Rig& rig, const Motion& motion, Eigen::Index k, double period) {
  Eigen::VectorXd readings = readings_of(rig, motion.positions.col(k));
  for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
    const double share = rig.sensors[s].held_share;
    const int held = share > 0.0 ? held_for(share, k) : 0;
    if (rig.sensors[s].late != 0.0 || held > 0) {
      const double at = static_cast<double>(k - held) - rig.sensors[s].late / period;
      const auto i = static_cast<Eigen::Index>(s);
      readings[i] = readings_of(rig, positions_between(motion, at, period))[i];
    }
    if (rig.sensors[s].lost_share > 0.0) {
      readings[static_cast<Eigen::Index>(s)] -= missed_until(rig.sensors[s], s, rig, motion, k, period);
    }
  }
  return readings;
}

Recording record(const Rig& rig, const Experiment& experiment, const model::Model& model,
                 const std::string& mujoco) {
  const Vector start = start_of(rig, experiment);
  Recording recording{rig, experiment.locked, start, experiment.period, {}};
  const Machine machine(rig, experiment.locked, start);
  const Eigen::MatrixXd given =
      validation::command_samples(model, experiment.commands, experiment.time.size());
  std::vector<Cascade> loops;
  for (const validation::Controller& one : experiment.controllers) {
    loops.emplace_back(one, rig, experiment.period);
  }
  std::mt19937_64 unused;
  const Commander commander = [&](Eigen::Index k, const Eigen::VectorXd& readings, Vector& commands) {
    for (std::size_t m = 0; m < rig.motors.size(); ++m) {
      commands[static_cast<Eigen::Index>(m)] = given(model.motor_index(rig.motors[m].name), k);
      for (Cascade& loop : loops) {
        if (loop.motor() == rig.motors[m].name) {
          const Sensor& sensor = rig.sensors[static_cast<std::size_t>(loop.sensor())];
          commands[static_cast<Eigen::Index>(m)] =
              loop.command(k, counted(sensor, readings[loop.sensor()], unused));
        }
      }
    }
  };
  Vector first = Vector::Zero(static_cast<Eigen::Index>(rig.motors.size()));
  for (std::size_t m = 0; m < rig.motors.size(); ++m) {
    first[static_cast<Eigen::Index>(m)] = given(model.motor_index(rig.motors[m].name), 0);
  }
  const Eigen::Index samples = experiment.time.size();
  recording.motion =
      mujoco.empty()
          ? machine.run(machine.start_state(first), 0, samples, experiment.period, commander)
          : run_in_mujoco(rig, mujoco, experiment.locked, start, samples, experiment.period, commander);
  if (!recording.motion.positions.allFinite()) {
    throw std::runtime_error("the foreign world's motion is not finite");
  }
  return recording;
}

Trial trial_of(const Recording& recording, const Experiment& experiment, const model::Model& model,
               std::mt19937_64& noise) {
  const Rig& rig = recording.rig;
  const Eigen::Index samples = recording.motion.positions.cols();
  Trial trial;
  trial.title = experiment.title;
  trial.model_file = model.file;
  trial.role = experiment.role;
  trial.time = experiment.time;
  trial.period = experiment.period;
  for (const model::Motor& motor : model.motors) {
    for (std::size_t m = 0; m < rig.motors.size(); ++m) {
      if (rig.motors[m].name == motor.name) {
        trial.commands.push_back({motor.name, "u_" + motor.name, motor.command_unit,
                                  recording.motion.commands.row(static_cast<Eigen::Index>(m)).transpose()});
      }
    }
  }
  for (const Sensor& sensor : rig.sensors) {
    validation::Measured channel;
    channel.sensor = sensor.name;
    channel.values.resize(samples);
    trial.measured.push_back(channel);
  }
  for (const std::string& name : rig.switches) {
    trial.switches.push_back({name, "", Eigen::VectorXd::Zero(samples)});
  }
  for (Eigen::Index k = 0; k < samples; ++k) {
    const Vector full = recording.motion.positions.col(k);
    const Vector full_rate = recording.motion.rates.col(k);
    const Eigen::VectorXd readings = readings_at(rig, recording.motion, k, recording.period);
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      trial.measured[s].values[k] = counted(rig.sensors[s], readings[static_cast<Eigen::Index>(s)], noise);
    }
    for (std::size_t i = 0; i < rig.switches.size(); ++i) {
      trial.switches[i].values[k] = is_closed(rig, rig.grounds[i], full, full_rate) ? 1.0 : 0.0;
    }
  }
  for (const std::string& name : recording.locked) {
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      if (rig.sensors[s].motor == name) {
        trial.locks.push_back({name, trial.measured[s].values[0]});
      }
    }
  }
  trial.contact_events = validation::contact_events(trial);
  return trial;
}

}  // namespace plumbline::battery::worlds
