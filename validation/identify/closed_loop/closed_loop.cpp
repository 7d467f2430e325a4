#include "validation/identify/closed_loop/closed_loop.h"

#include <cmath>
#include <stdexcept>

#include "simulator/run/commanded_run.h"
#include "validation/identify/closed_loop/controllers.h"
#include "validation/identify/predict/tolerance.h"

namespace plumbline::validation {
namespace {

constexpr Eigen::Index kDifferenceSamples = 2;  // before these, the controller's own past is not recorded

/// A controller with its places in the model and its records in the trial.
struct Loop {
  const Controller* controller = nullptr;
  Eigen::Index motor = -1, sensor = -1;
  const Eigen::VectorXd* measured = nullptr;
  const Eigen::VectorXd* commanded = nullptr;
};

std::vector<Loop> loops_of(const model::Model& model, const Trial& trial) {
  std::vector<Loop> loops;
  for (const Controller& controller : trial.controllers) {
    Loop loop;
    loop.controller = &controller;
    loop.motor = model.motor_index(controller.motor);
    loop.sensor = model.sensor_index(controller.sensor);
    for (const Measured& measured : trial.measured) {
      loop.measured = measured.sensor == controller.sensor ? &measured.values : loop.measured;
    }
    for (const Command& command : trial.commands) {
      loop.commanded = command.motor == controller.motor ? &command.values : loop.commanded;
    }
    loops.push_back(loop);
  }
  return loops;
}

std::string missing_record(const std::vector<Loop>& loops) {
  if (loops.empty()) {
    return "no controller is known";
  }
  for (const Loop& loop : loops) {
    if (loop.measured == nullptr) {
      return "sensor " + loop.controller->sensor + " of the controller was not recorded";
    }
    if (loop.commanded == nullptr) {
      return "the command of motor " + loop.controller->motor + " was not recorded";
    }
  }
  return "";
}

double percent(const Eigen::VectorXd& measured, const Eigen::VectorXd& simulated) {
  const double size = measured.norm();
  return size > 0.0 ? 100.0 * (measured - simulated).norm() / size : 0.0;
}

/// The controller's equation on the recorded measurement, without its disturbance.
Eigen::VectorXd replayed(const Loop& loop, double period) {
  const Controller& c = *loop.controller;
  controllers::CascadePd law = law_of(c, period);
  const Eigen::VectorXd& measured = *loop.measured;
  Eigen::VectorXd command(measured.size());
  for (Eigen::Index k = 0; k < measured.size(); ++k) {
    command[k] = law.command(c.reference[k], measured[k]);
  }
  return command;
}

void check_equation(const Loop& loop, double period, LoopError& error) {
  const Eigen::Index n = loop.measured->size() - kDifferenceSamples;
  Eigen::VectorXd rest = (*loop.commanded - replayed(loop, period)).tail(n);
  if (loop.controller->disturbance.size() > 0) {
    const Eigen::VectorXd disturbance = loop.controller->disturbance.tail(n);
    const double size = disturbance.squaredNorm();
    error.disturbance_factor = size > 0.0 ? rest.dot(disturbance) / size : 0.0;
    rest -= disturbance;
  }
  error.equation_rms = std::sqrt(rest.squaredNorm() / static_cast<double>(n));
}

run::CommandedRun simulate(Predictor& predictor, const Trial& trial, double relative_tolerance) {
  model::Plant& plant = predictor.plant();
  const Eigen::VectorXd x0 = predictor.initial_state({0, 0, trial.samples()});
  TrialControllers controllers(plant, trial, x0);
  const run::SampledController control = [&](Eigen::Index k, double, const Eigen::VectorXd& y,
                                             double* command) {
    controllers.command(k, y, command);
    if (!y.allFinite()) {
      throw std::runtime_error("the simulated motion is not finite");
    }
  };
  run::CommandedOptions run;
  run.energy = false;
  run.events = false;
  run.integrator.set_tolerance(relative_tolerance);
  return run::run_commands(plant, x0, command_samples(plant.model(), trial.commands, trial.samples()),
                           trial.period, trial.time[0], control, nullptr, run);
}

}  // namespace

ClosedLoop closed_loop(const model::Model& model, const Trial& trial, const PredictOptions& options) {
  ClosedLoop result;
  const std::vector<Loop> loops = loops_of(model, trial);
  result.not_available = missing_record(loops);
  if (!result.not_available.empty()) {
    return result;
  }
  Predictor predictor(model, trial, options);
  const double tolerance = options.relative_tolerance > 0.0 ? options.relative_tolerance : kRelativeTolerance;
  try {
    const run::CommandedRun run = simulate(predictor, trial, tolerance);
    result.readings = run.readings;
    result.commands = run.commands;
  } catch (const std::runtime_error& error) {
    result.not_available = std::string("the loop could not be simulated: ") + error.what();
    return result;
  }
  for (const Loop& loop : loops) {
    LoopError error;
    error.motor = loop.controller->motor;
    error.sensor = loop.controller->sensor;
    error.force_unit = model.motors[static_cast<std::size_t>(loop.motor)].angular ? "N m" : "N";
    error.position_percent = percent(*loop.measured, result.readings.row(loop.sensor).transpose());
    // The torque gain is a common factor of both sides.
    error.force_percent = percent(*loop.commanded, result.commands.row(loop.motor).transpose());
    check_equation(loop, trial.period, error);
    result.loops.push_back(error);
  }
  return result;
}

}  // namespace plumbline::validation
