#include "simulator/run/commanded_run.h"

#include "simulator/integrate/command_clock.h"

namespace plumbline::run {
namespace {

CommandedRun sized(const model::Plant& plant, Eigen::Index samples) {
  CommandedRun result;
  result.time.resize(samples);
  result.states.resize(plant.states(), samples);
  result.outputs.resize(plant.sensors(), samples);
  result.readings.resize(plant.sensors(), samples);
  result.switches.resize(static_cast<Eigen::Index>(plant.model().switches.size()), samples);
  result.commands.resize(plant.motors(), samples);
  return result;
}

}  // namespace

CommandedRun run_commands(model::Plant& plant, const Eigen::VectorXd& x0, const Eigen::MatrixXd& commands,
                          double period, double t0, const SampledController& controller, Sensors* sensors,
                          const CommandedOptions& options) {
  const Eigen::Index samples = commands.cols();
  CommandedRun result = sized(plant, samples);
  Simulation simulation(plant, {options.integrator, period, options.energy, options.events});
  simulation.start(x0, t0);
  if (options.before.size() > 0) {
    simulation.hold_until_first_arrives(options.before);
  } else if (samples > 0) {
    simulation.hold(commands.col(0));
  }
  Sensors exact(plant.model(), {false, false, 0});
  Sensed sensed;
  const std::vector<effects::ClockError> clocks = integrate::command_clocks(plant);
  const bool is_other_clock = !controller && integrate::is_any_wrong(clocks);
  const Eigen::MatrixXd arriving =
      is_other_clock ? integrate::on_clock_of_measurements(commands, period, clocks) : Eigen::MatrixXd();
  Eigen::VectorXd command;
  for (Eigen::Index k = 0; k < samples; ++k) {
    simulation.measure();
    (sensors != nullptr ? *sensors : exact).read(simulation.outputs(), simulation.touches(), sensed);
    result.time[k] = simulation.time();
    result.states.col(k) = simulation.state();
    result.outputs.col(k) = simulation.outputs();
    result.readings.col(k) = sensed.readings;
    result.switches.col(k) = sensed.switches;
    command = commands.col(k);
    if (controller) {
      controller(k, simulation.time(), sensed.readings, command.data());
    }
    result.commands.col(k) = command;
    if (is_other_clock) {
      command = arriving.col(k);
    }
    if (options.energy) {
      simulation.account(command);
    }
    if (k + 1 < samples) {
      simulation.advance(command);
    }
  }
  if (options.energy) {
    result.energy_error = simulation.energy_error();
    result.energy_exchanged = simulation.energy_exchanged();
  }
  result.events = simulation.events();
  result.summary = simulation.summary();
  return result;
}

}  // namespace plumbline::run
