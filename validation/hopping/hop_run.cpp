#include "validation/hopping/hop_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "simulator/integrate/plant_ode.h"
#include "simulator/trace/error.h"
#include "validation/hopping/hopping_loop.h"

namespace plumbline::validation {
namespace {

using controllers::HoppingPhase;

constexpr double kLowestHip = -0.5;    // m, against a level boom at 1 m
constexpr double kLargestTorso = 1.0;  // rad
constexpr double kLongestPhase = 1.5;  // s

/// What is looked at in a run, from the sensors' true positions.
class Watch {
 public:
  Watch(const model::Model& model, const controllers::HoppingConfig& config)
      : config_(config), in_the_plane_(model.sensor_index("boom_pitch") < 0) {
    torso_ = model.sensor_index("torso");
    travel_ = model.sensor_index(in_the_plane_ ? "hip_x" : "tower");
    height_ = model.sensor_index(in_the_plane_ ? "hip_z" : "boom_pitch");
  }

  double torso(const Eigen::VectorXd& y) const { return y[torso_]; }
  double travel(const Eigen::VectorXd& y) const {
    return in_the_plane_ ? y[travel_] : config_.boom_length * y[travel_];
  }
  double height(const Eigen::VectorXd& y) const {
    return in_the_plane_ ? y[height_] : config_.boom_length * std::sin(y[height_]);
  }

 private:
  controllers::HoppingConfig config_;
  bool in_the_plane_;
  int torso_ = 0, travel_ = 0, height_ = 0;
};

/// Gathers hops while the run goes on.
class Counter {
 public:
  Counter(const Watch& watch, HopRun& run) : watch_(watch), run_(run) {}

  void feet(double t, const std::vector<model::Touch>& touches) {
    for (std::size_t f = 0; f < 2; ++f) {
      const bool down = touches[f].depth > 0.0;
      if (down && !down_[f]) {
        since_[f] = t;
      }
      down_[f] = down;
    }
  }

  void load(const controllers::HoppingTorques& torques, double stretch_LA, double stretch_LS) {
    const auto raise = [](double& most, double value) { most = std::max(most, std::abs(value)); };
    raise(now_.largest_torque_mLA, torques.mLA_left);
    raise(now_.largest_torque_mLA, torques.mLA_right);
    raise(now_.largest_torque_mLS, torques.mLS_left);
    raise(now_.largest_torque_mLS, torques.mLS_right);
    raise(now_.largest_stretch_LA, stretch_LA);
    raise(now_.largest_stretch_LS, stretch_LS);
  }

  void sample(double t, const Eigen::VectorXd& y, const controllers::Hopping& controller) {
    now_.lowest_hip = std::min(now_.lowest_hip, watch_.height(y));
    now_.highest_hip = std::max(now_.highest_hip, watch_.height(y));
    const bool first = !landed_ && controller.phase() == HoppingPhase::touchdown;
    if (first || controller.hops() > static_cast<long>(run_.hops.size())) {
      land(t, y, controller);
    }
  }

 private:
  void land(double t, const Eigen::VectorXd& y, const controllers::Hopping& controller) {
    if (landed_) {
      now_.landing = t;
      now_.period = t - last_time_;
      now_.travel = watch_.travel(y) - last_travel_;
      now_.torso = watch_.torso(y);
      now_.torso_wanted = controller.h_T_d();
      now_.touchdown_gap = std::abs(since_[0] - since_[1]);
      run_.hops.push_back(now_);
    }
    landed_ = true;
    last_time_ = t;
    last_travel_ = watch_.travel(y);
    now_ = Hop();
    now_.lowest_hip = now_.highest_hip = watch_.height(y);
  }

  const Watch& watch_;
  HopRun& run_;
  Hop now_;
  bool landed_ = false;
  double last_time_ = 0.0, last_travel_ = 0.0;
  bool down_[2] = {false, false};
  double since_[2] = {0.0, 0.0};
};

/// The larger |c(q)| of both legs (equation 23), rad of motor.
double stretch(const model::Plant& plant, const std::string& ratio, const Eigen::VectorXd& x) {
  double most = 0.0;
  for (const char* side : {"_left", "_right"}) {
    most = std::max(most, std::abs(plant.motion_at(effects::Place::ratio, ratio + side, x.data()).position));
  }
  return most;
}

/// Every sample of a run, a row each.
class Recorder {
 public:
  explicit Recorder(const model::Model& model) {
    columns_.push_back({"t", "s", {}});
    for (const model::Sensor& sensor : model.sensors) {
      const bool angular = model.place_is_angular(effects::Place::sensor, sensor.name);
      columns_.push_back({"q_" + sensor.name, angular ? "rad" : "m", {}});
    }
    for (const model::Motor& motor : model.motors) {
      columns_.push_back({"u_" + motor.name, motor.command_unit, {}});
    }
    for (const model::Foot& foot : model.feet) {
      for (const char* axis : {"x", "y", "z"}) {
        columns_.push_back({"F_" + foot.name + "_" + axis, "N", {}});
      }
    }
    columns_.push_back({"phase", "1", {}});
    columns_.push_back({"torso_wanted", "rad", {}});
  }

  void row(double t, const Eigen::VectorXd& y, const Eigen::VectorXd& u,
           const std::vector<model::Touch>& touches, const controllers::Hopping& controller) {
    values_.push_back(t);
    values_.insert(values_.end(), y.data(), y.data() + y.size());
    values_.insert(values_.end(), u.data(), u.data() + u.size());
    for (const model::Touch& touch : touches) {
      values_.insert(values_.end(), touch.force.data(), touch.force.data() + 3);
    }
    values_.push_back(static_cast<double>(controller.phase()));
    values_.push_back(controller.h_T_d());
  }

  Table table() const {
    Table table;
    table.columns = columns_;
    const auto width = static_cast<Eigen::Index>(columns_.size());
    const auto rows = static_cast<Eigen::Index>(values_.size()) / width;
    const Eigen::Map<const Eigen::MatrixXd> all(values_.data(), width, rows);
    for (Eigen::Index c = 0; c < width; ++c) {
      table.columns[static_cast<std::size_t>(c)].values = all.row(c).transpose();
    }
    return table;
  }

 private:
  std::vector<Column> columns_;
  std::vector<double> values_;
};

std::string fall(const Watch& watch, const Eigen::VectorXd& y, const controllers::Hopping& controller) {
  if (!y.allFinite()) {
    return "the state is not finite";
  }
  if (watch.height(y) < kLowestHip) {
    return "fell: the hip is down";
  }
  if (std::abs(watch.torso(y)) > kLargestTorso) {
    return std::string("fell ") + (watch.torso(y) > 0.0 ? "backward" : "forward") +
           ": the torso has turned over";
  }
  if (controller.time_in_phase() > kLongestPhase) {
    return std::string("stays in phase ") + to_string(controller.phase());
  }
  return "";
}

}  // namespace

HopOptions::HopOptions() {
  integrator.method = integrate::Method::rosenbrock;
  integrator.relative_tolerance = 1e-5;
  integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-7);
  integrator.max_steps = 2000;  // in a sample; more is no progress
}

HopRun hop(const model::Model& model, const controllers::HoppingConfig& config, const HopStart& start,
           const HopOptions& options) {
  model::Plant plant(model, {});
  HoppingLoop loop(model, config);
  const Watch watch(model, config);
  HopRun run;
  Counter counter(watch, run);
  Recorder recorder(model);
  integrate::PlantOde ode(plant, false, false);
  integrate::Integrator integrator(ode, options.integrator);
  integrator.start(0.0, start_state(plant, config, start));
  Eigen::VectorXd y(plant.sensors());
  Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
  const auto begin = std::chrono::steady_clock::now();
  try {
    for (long k = 0;; ++k) {
      if (options.stop != nullptr && options.stop->raised) {
        throw Stopped();
      }
      run.time = static_cast<double>(k) * config.period;
      const Eigen::VectorXd& x = integrator.state();
      plant.outputs(x.data(), y.data());
      const std::vector<model::Touch> touches = plant.touches(x.data());
      loop.command(y, touches, command.data());
      counter.feet(run.time, touches);
      counter.load(loop.torques(), stretch(plant, "leg_angle", x), stretch(plant, "leg_shape", x));
      counter.sample(run.time, y, loop.controller());
      if (options.trace) {
        recorder.row(run.time, y, command, touches, loop.controller());
      }
      run.end = fall(watch, y, loop.controller());
      run.fell = !run.end.empty();
      if (run.fell || static_cast<long>(run.hops.size()) >= options.hops || run.time >= options.longest) {
        break;
      }
      std::copy(command.data(), command.data() + command.size(), ode.command());
      integrator.input_changed(true);
      integrator.advance(static_cast<double>(k + 1) * config.period);
    }
  } catch (const Stopped&) {
    throw;
  } catch (const InputError&) {
    throw;
  } catch (const std::runtime_error& error) {
    run.fell = true;
    run.end = error.what();
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  run.summary = integrator.summary();
  if (options.trace) {
    run.trace = recorder.table();
  }
  return run;
}

}  // namespace plumbline::validation
