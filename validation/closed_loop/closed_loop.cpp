#include "validation/closed_loop/closed_loop.h"

#include <cmath>
#include <stdexcept>

#include "controllers/cascade_pd.h"
#include "simulator/integrate/run.h"

namespace plumbline::validation {
namespace {

constexpr Eigen::Index kDifferenceSamples = 2;  // before these, the controller's own past is not recorded

controllers::CascadePd controller_of(const Controller& c, double period) {
  return controllers::CascadePd({c.position_gain, c.velocity_gain, c.command_limit, period, c.velocity_over});
}

double disturbance_at(const Controller& c, Eigen::Index k) {
  return c.disturbance.size() > 0 ? c.disturbance[k] : 0.0;
}

template <typename Item>
Eigen::Index index_of(const std::vector<Item>& items, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) {
      return static_cast<Eigen::Index>(i);
    }
  }
  return -1;
}

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
    loop.motor = index_of(model.motors, controller.motor);
    loop.sensor = index_of(model.sensors, controller.sensor);
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
  controllers::CascadePd controller = controller_of(c, period);
  const Eigen::VectorXd& measured = *loop.measured;
  Eigen::VectorXd command(measured.size());
  for (Eigen::Index k = 0; k < measured.size(); ++k) {
    command[k] = controller.command(c.reference[k], measured[k]);
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

std::vector<double> delays_of(const model::Plant& plant) {
  std::vector<double> delays;
  delays.reserve(static_cast<std::size_t>(plant.motors()));
  for (int m = 0; m < plant.motors(); ++m) {
    delays.push_back(plant.delay(m));
  }
  return delays;
}

Eigen::MatrixXd recorded_commands(const model::Model& model, const Trial& trial) {
  Eigen::MatrixXd samples =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(model.motors.size()), trial.samples());
  for (const Command& command : trial.commands) {
    samples.row(index_of(model.motors, command.motor)) = command.values.transpose();
  }
  return samples;
}

/// Controllers that arrive at the start with the motion that x0 has.
std::vector<controllers::CascadePd> started(const std::vector<Loop>& loops, model::Plant& plant,
                                            const Eigen::VectorXd& x0, double period) {
  Eigen::VectorXd y(plant.sensors());
  Eigen::MatrixXd slope;
  plant.outputs(x0.data(), y.data());
  plant.output_jacobian(x0.data(), slope);
  const Eigen::VectorXd rate = slope * x0.segment(plant.positions(), plant.positions());
  std::vector<controllers::CascadePd> controllers;
  for (const Loop& loop : loops) {
    controllers.push_back(controller_of(*loop.controller, period));
    controllers.back().reset(y[loop.sensor], rate[loop.sensor]);
  }
  return controllers;
}

integrate::RunResult simulate(Predictor& predictor, const model::Model& model, const Trial& trial,
                              const std::vector<Loop>& loops, double relative_tolerance) {
  model::Plant& plant = predictor.plant();
  const Eigen::VectorXd x0 = predictor.initial_state({0, 0, trial.samples()});
  std::vector<controllers::CascadePd> controllers = started(loops, plant, x0, trial.period);
  const integrate::SampledController control = [&](Eigen::Index k, double, const Eigen::VectorXd& y,
                                                   double* command) {
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const Controller& c = *loops[i].controller;
      command[loops[i].motor] =
          controllers[i].command(c.reference[k], y[loops[i].sensor], disturbance_at(c, k));
    }
    if (!y.allFinite()) {
      throw std::runtime_error("the simulated motion is not finite");
    }
  };
  integrate::RunOptions run;
  run.energy = false;
  run.events = false;
  run.integrator.relative_tolerance = relative_tolerance;
  run.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, relative_tolerance * 1e-2);
  const integrate::HeldCommands commands(recorded_commands(model, trial), trial.period, delays_of(plant));
  return integrate::run(plant, x0, commands, trial.time[0], control, {}, run);
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
  try {
    const integrate::RunResult run = simulate(predictor, model, trial, loops, options.relative_tolerance);
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
