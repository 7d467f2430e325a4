#include "validation/identify/twin/twin.h"

#include <Eigen/QR>
#include <cmath>
#include <random>
#include <sstream>

#include "simulator/integrate/command_clock.h"
#include "simulator/run/commanded_run.h"
#include "simulator/sensing/encoder.h"
#include "simulator/trace/error.h"
#include "validation/identify/closed_loop/controllers.h"

namespace plumbline::validation {
namespace {

double number_of(const std::string& text, const std::string& whole) {
  try {
    std::size_t used = 0;
    const double value = std::stod(text, &used);
    if (used == text.size() && !std::isnan(value)) {
      return value;
    }
  } catch (const std::exception&) {
    // falls through to the message
  }
  throw InputError("'" + whole + "': found '" + text + "', expected a number");
}

}  // namespace

double sensor_reading(const model::Sensor& sensor, double actual, std::mt19937_64& random) {
  const double noisy = sensing::with_noise(actual, sensor.noise, random);
  return sensor.resolution > 0.0 ? sensing::Encoder{sensor.resolution, 1.0, 0.0}.reading(noisy) : noisy;
}

model::EffectUse parse_effect(const std::string& text, const model::Model& model,
                              const effects::Catalogue& catalogue) {
  const std::size_t at = text.find('@');
  const std::size_t colon = text.find(':', at == std::string::npos ? 0 : at);
  if (at == std::string::npos) {
    throw InputError("'" + text + "': found no place, expected EFFECT@WHERE:param=value");
  }
  model::EffectUse use;
  const std::string name = text.substr(0, at);
  use.law = catalogue.find(name);
  if (!use.law) {
    std::vector<std::string> known;
    for (const auto& law : catalogue.laws()) {
      known.push_back(law->declaration().name);
    }
    throw InputError("'" + text + "': unknown effect '" + name + "'" + nearest_names(name, known));
  }
  use.at = text.substr(at + 1, colon == std::string::npos ? std::string::npos : colon - at - 1);
  model.resolve(*use.law, use.at);
  const effects::Declaration& declaration = use.law->declaration();
  const effects::Values shape = use.law->starts({}).front();
  std::vector<std::string> names;
  for (std::size_t p = 0; p < declaration.parameters.size(); ++p) {
    model::Quantity quantity;
    quantity.value = declaration.parameters[p].structural ? shape[p] : declaration.parameters[p].null_value;
    use.values.push_back(quantity);
    names.push_back(declaration.parameters[p].name);
  }
  std::stringstream rest(colon == std::string::npos ? "" : text.substr(colon + 1));
  for (std::string item; std::getline(rest, item, ',');) {
    const std::size_t equal = item.find('=');
    const std::string parameter = item.substr(0, equal);
    const int index = use.law->parameter_index(parameter);
    if (equal == std::string::npos || index < 0) {
      std::ostringstream found;
      found << "'" << text << "': unknown parameter '" << parameter << "' of " << name
            << nearest_names(parameter, names);
      throw InputError(found.str());
    }
    const effects::Parameter& declared = declaration.parameters[static_cast<std::size_t>(index)];
    const double value = number_of(item.substr(equal + 1), text);
    if (value < declared.lower || value > declared.upper) {
      std::ostringstream range;
      range << "'" << text << "': found " << parameter << " = " << value << ", expected " << declared.lower
            << " to " << declared.upper;
      throw InputError(range.str());
    }
    use.values[static_cast<std::size_t>(index)].value = value;
  }
  return use;
}

std::vector<model::Lock> locks_of(const model::Model& model, const Experiment& experiment) {
  if (experiment.locked.empty()) {
    return {};
  }
  model::Plant free(model, {});
  const Eigen::VectorXd x = start_state(free, experiment);
  std::vector<model::Lock> locks;
  for (const std::string& name : experiment.locked) {
    locks.push_back({name, free.position_of(name, x.data())});
  }
  return locks;
}

namespace {

/// The position that closes the loops and has the start's values.
Eigen::VectorXd on_loops(model::Plant& plant, const Experiment& experiment, const Eigen::MatrixXd& C,
                         const Eigen::VectorXd& y) {
  constexpr double kReached = 1e-6;  // rad or m
  Eigen::VectorXd z = plant.home();
  const bool closed = plant.closure()->close(C, y, z);
  const auto starts = static_cast<Eigen::Index>(experiment.start.size());
  if (!closed || !((C * z - y).head(starts).norm() <= kReached)) {
    throw InputError({experiment.file, 0, "start"}, "positions at which the model's loops cannot be closed",
                     "positions that the loops allow; coordinates that are not named follow the others");
  }
  return z;
}

void settle_at_start(const model::Plant& plant, const Experiment& experiment, Eigen::VectorXd& x) {
  const Eigen::MatrixXd samples = command_samples(plant.model(), experiment.commands, experiment.time.size());
  const Eigen::VectorXd first = samples.col(0);
  plant.settle(first.data(), x.data());
}

}  // namespace

Eigen::VectorXd start_state(model::Plant& plant, const Experiment& experiment) {
  const Eigen::Index nz = plant.positions();
  const auto starts = static_cast<Eigen::Index>(experiment.start.size());
  // Positions that the experiment does not name are zero; unseen stretches too. Least squares weighs the
  // named ones far above the rest.
  const Eigen::MatrixXd& stretch = plant.stretch_map();
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(starts + stretch.rows() + nz, nz);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(C.rows());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (Eigen::Index i = 0; i < starts; ++i) {
    const Start& start = experiment.start[static_cast<std::size_t>(i)];
    x.setZero();
    const double offset = plant.position_of(start.coordinate, x.data());
    for (Eigen::Index j = 0; j < nz; ++j) {
      x[nz + j] = 1.0;
      C(i, j) = plant.velocity_of(start.coordinate, x.data());
      x[nz + j] = 0.0;
    }
    right[i] = start.position - offset;
  }
  C.middleRows(starts, stretch.rows()) = 1e-2 * stretch;
  if (plant.closure() != nullptr) {
    const Eigen::Index named = starts + stretch.rows();
    x.head(nz) = on_loops(plant, experiment, C.topRows(named), right.head(named));
    settle_at_start(plant, experiment, x);
    return x;
  }
  C.bottomRows(nz) = 1e-7 * Eigen::MatrixXd::Identity(nz, nz);
  x.head(nz) = C.colPivHouseholderQr().solve(right);
  settle_at_start(plant, experiment, x);
  return x;
}

namespace {

/// What the contact switches read, late as the model says, and by the effects at them.
std::vector<SwitchRecord> switch_records(const model::Model& model, const run::CommandedRun& result,
                                         double period) {
  const model::Plant plant(model, {});
  std::vector<SwitchRecord> records;
  for (std::size_t s = 0; s < model.switches.size(); ++s) {
    const Eigen::VectorXd closed = result.switches.row(static_cast<Eigen::Index>(s)).transpose();
    model::ContactSwitch late = model.switches[s];
    late.closes_late += plant.switch_lateness(late.name, true);
    late.opens_late += plant.switch_lateness(late.name, false);
    records.push_back(record_of(model.switches[s], "", read_late(late, closed, period)));
  }
  return records;
}

}  // namespace

Trial twin(const model::Model& model, const Experiment& experiment, const TwinOptions& options) {
  Trial trial;
  trial.title = experiment.title;
  trial.model_file = model.file;
  trial.role = experiment.role;
  trial.time = experiment.time;
  trial.period = experiment.period;
  trial.commands = experiment.commands;
  trial.controllers = experiment.controllers;
  trial.locks = locks_of(model, experiment);
  model::Plant plant(model, trial.locks);
  run::Sensors sensors(model, {true, options.quantise, options.seed});
  run::CommandedOptions run;
  run.energy = false;
  run.events = false;
  run.integrator.set_tolerance(options.relative_tolerance);
  const Eigen::VectorXd x0 = start_state(plant, experiment);
  TrialControllers loops(plant, trial, x0);
  const run::SampledController control = [&](Eigen::Index k, double, const Eigen::VectorXd& y,
                                             double* command) { loops.command(k, y, command); };
  const bool closed = !trial.controllers.empty();
  if (closed && integrate::is_any_wrong(integrate::command_clocks(plant))) {
    throw InputError({experiment.file, 0, "controllers"}, "a controller, and clock_drift in the model",
                     "commands alone: a clock's error is one of recorded commands");
  }
  const run::CommandedRun result =
      run::run_commands(plant, x0, command_samples(model, experiment.commands, experiment.time.size()),
                        experiment.period, 0.0, closed ? control : run::SampledController(), &sensors, run);
  for (Command& command : trial.commands) {
    if (closed) {
      command.values = result.commands.row(model.motor_index(command.motor)).transpose();
    }
  }
  for (std::size_t s = 0; s < model.sensors.size(); ++s) {
    Measured channel;
    channel.sensor = model.sensors[s].name;
    channel.values = result.readings.row(static_cast<Eigen::Index>(s)).transpose();
    trial.measured.push_back(std::move(channel));
  }
  trial.switches = switch_records(model, result, experiment.period);
  trial.contact_events = contact_events(trial);
  return trial;
}

}  // namespace plumbline::validation
