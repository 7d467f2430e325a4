#include "validation/identify/replay/replay.h"

#include <chrono>
#include <cmath>

#include "simulator/model/kinds.h"
#include "simulator/trace/error.h"
#include "validation/identify/closed_loop/controllers.h"
#include "validation/identify/predict/flight_start.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

void add_place(model::Plant& plant, const std::string& name, bool angular, const Eigen::MatrixXd& states,
               Table& trace) {
  Eigen::VectorXd position(states.cols());
  Eigen::VectorXd velocity(states.cols());
  for (Eigen::Index k = 0; k < states.cols(); ++k) {
    position[k] = plant.position_of(name, states.col(k).data());
    velocity[k] = plant.velocity_of(name, states.col(k).data());
  }
  const std::string unit = model::position_unit(angular);
  trace.columns.push_back({"x_" + name, unit, std::move(position)});
  trace.columns.push_back({"v_" + name, unit + "/s", std::move(velocity)});
}

void add_forces(model::Plant& plant, const Eigen::MatrixXd& states, Table& trace) {
  const std::size_t feet = plant.model().feet.size();
  std::vector<Eigen::Matrix3Xd> forces(feet, Eigen::Matrix3Xd::Zero(3, states.cols()));
  for (Eigen::Index k = 0; k < states.cols() && feet > 0; ++k) {
    const std::vector<model::Touch> touches = plant.touches(states.col(k).data());
    for (std::size_t f = 0; f < touches.size(); ++f) {
      forces[f].col(k) = touches[f].force;
    }
  }
  for (std::size_t f = 0; f < feet; ++f) {
    for (int axis = 0; axis < 3; ++axis) {
      trace.columns.push_back(
          {"F_" + plant.model().feet[f].name + "_" + "xyz"[axis], "N", forces[f].row(axis).transpose()});
    }
  }
}

void add_contact_forces(model::Plant& plant, const Eigen::MatrixXd& states, Table& trace) {
  const std::vector<model::LinkContact>& contacts = plant.model().contacts;
  std::vector<Eigen::Matrix3Xd> forces(contacts.size(), Eigen::Matrix3Xd::Zero(3, states.cols()));
  for (Eigen::Index k = 0; k < states.cols() && !contacts.empty(); ++k) {
    const std::vector<Eigen::Vector3d> now = plant.contact_forces(states.col(k).data());
    for (std::size_t c = 0; c < now.size(); ++c) {
      forces[c].col(k) = now[c];
    }
  }
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      trace.columns.push_back(
          {"F_" + contacts[c].name + "_" + "xyz"[axis], "N", forces[c].row(axis).transpose()});
    }
  }
}

Table trace_of(model::Plant& plant, const run::CommandedRun& run) {
  const model::Model& model = plant.model();
  Table trace;
  trace.columns.push_back({"t", "s", run.time});
  for (std::size_t s = 0; s < model.sensors.size(); ++s) {
    const std::string& name = model.sensors[s].name;
    trace.columns.push_back({model::reading_column(model.sensors[s]), model::reading_unit(model, name),
                             run.outputs.row(static_cast<Eigen::Index>(s)).transpose()});
  }
  for (std::size_t m = 0; m < model.motors.size(); ++m) {
    trace.columns.push_back({"u_" + model.motors[m].name, model.motors[m].command_unit,
                             run.commands.row(static_cast<Eigen::Index>(m)).transpose()});
  }
  for (const model::Coordinate& coordinate : model.coordinates) {
    add_place(plant, coordinate.name, coordinate.angular, run.states, trace);
  }
  for (const model::Motor& motor : model.motors) {
    add_place(plant, motor.name, motor.angular, run.states, trace);
  }
  add_forces(plant, run.states, trace);
  add_contact_forces(plant, run.states, trace);
  return trace;
}

struct Beginning {
  Eigen::VectorXd x0;
  Eigen::MatrixXd commands;
  double time = 0.0, period = 1e-3;
  Eigen::VectorXd before{};
};

Replay run(model::Plant& plant, const Beginning& start, TrialControllers* loops,
           const ReplayOptions& options) {
  const auto each_sample = [&](Eigen::Index sample, double /*time*/, const Eigen::VectorXd& readings,
                               double* command) {
    if (options.stop != nullptr && options.stop->raised) {
      throw Stopped();
    }
    if (loops != nullptr) {
      loops->command(sample, readings, command);
    }
  };
  run::CommandedOptions run_options;
  run_options.integrator = options.integrator;
  run_options.before = start.before;
  const auto begin = std::chrono::steady_clock::now();
  Replay replay;
  run::Sensors sensors(plant.model(), {false, true, 0});  // without noise: a run is repeatable
  replay.run = run::run_commands(plant, start.x0, start.commands, start.period, start.time, each_sample,
                                 &sensors, run_options);
  replay.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  replay.duration = start.period * static_cast<double>(start.commands.cols() - 1);
  replay.trace = trace_of(plant, replay.run);
  return replay;
}

std::vector<ReplayError> errors_of(const model::Model& model, const Trial& trial,
                                   const run::CommandedRun& run) {
  std::vector<ReplayError> errors;
  for (const Measured& channel : trial.measured) {
    const int s = model.sensor_index(channel.sensor);
    const Eigen::VectorXd difference = channel.values - run.outputs.row(s).transpose();
    errors.push_back({channel.sensor, model::reading_unit(model, channel.sensor),
                      std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())),
                      sensor_of(model, channel).floor()});
  }
  return errors;
}

}  // namespace

Replay replay(const model::Model& model, const Trial& trial, const ReplayOptions& options) {
  if (options.closed_loop && trial.controllers.empty()) {
    throw InputError({trial.file, 0, "controllers"}, "none", "the controller that closes the loop");
  }
  Predictor predictor(model, trial, {});
  model::Plant& plant = predictor.plant();
  const Beginning start{state_at_start(predictor, trial, {0, 0, trial.samples()}),
                        command_samples(model, trial.commands, trial.samples()), trial.time[0], trial.period,
                        commands_before(model, trial.commands)};
  Replay result;
  if (options.closed_loop) {
    TrialControllers loops(plant, trial, start.x0);
    result = run(plant, start, &loops, options);
  } else {
    result = run(plant, start, nullptr, options);
  }
  result.errors = errors_of(model, trial, result.run);
  return result;
}

Replay replay(const model::Model& model, const Experiment& experiment, const ReplayOptions& options) {
  model::Plant plant(model, locks_of(model, experiment));
  const Beginning start{start_state(plant, experiment),
                        command_samples(model, experiment.commands, experiment.time.size()), 0.0,
                        experiment.period};
  if (experiment.controllers.empty()) {
    return run(plant, start, nullptr, options);
  }
  Trial controlled;
  controlled.file = experiment.file;
  controlled.controllers = experiment.controllers;
  TrialControllers loops(plant, controlled, start.x0);
  return run(plant, start, &loops, options);
}

}  // namespace plumbline::validation
