#include "simulator/integrate/run.h"

#include <algorithm>
#include <cmath>

#include "simulator/integrate/energy_account.h"
#include "simulator/integrate/plant_ode.h"
#include "simulator/integrate/plate_means.h"

namespace plumbline::integrate {
namespace {

/// Of a stretch over which a plate's force is averaged.
int pieces_of(double time) {
  constexpr double kPiece = 5e-5;  // s
  return std::max(1, static_cast<int>(std::ceil(time / kPiece)));
}

void read_sensors(model::Plant& plant, const Eigen::VectorXd& x, const PlateMeans& plates,
                  const Readout& readout, Eigen::Index sample, RunResult& result) {
  Eigen::VectorXd y(plant.sensors());
  plant.outputs(x.data(), y.data());
  plates.write(y.data());
  result.outputs.col(sample) = y;
  if (readout) {
    readout(y);
  }
  result.readings.col(sample) = y;
}

}  // namespace

RunResult run(model::Plant& plant, const Eigen::VectorXd& x0, HeldCommands commands, double t0,
              const SampledController& controller, const Readout& readout, const RunOptions& options) {
  const Eigen::Index samples = commands.samples();
  const Eigen::Index nx = plant.states();
  RunResult result;
  result.time.resize(samples);
  result.states.resize(nx, samples);
  result.outputs.resize(plant.sensors(), samples);
  result.readings.resize(plant.sensors(), samples);
  result.commands.resize(plant.motors(), samples);
  PlantOde ode(plant, options.energy, options.events);
  Integrator integrator(ode, options.integrator);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(ode.size());
  x.head(nx) = x0;
  integrator.start(t0, x);
  EnergyAccount account;
  PlateMeans plates(plant);
  Eigen::VectorXd command(plant.motors());
  for (Eigen::Index k = 0; k < samples; ++k) {
    const double t = t0 + static_cast<double>(k) * commands.period();
    result.time[k] = t;
    x = integrator.state();
    result.states.col(k) = x.head(nx);
    read_sensors(plant, x, plates, readout, k, result);
    plates.begin(t, x.data());
    commands.held(k, command.data());
    if (controller) {
      controller(k, t, result.readings.col(k), command.data());
      commands.set(k, command.data());
    }
    result.commands.col(k) = command;
    if (options.energy) {
      const double stored = plant.energetics(x.data(), command.data()).stored;
      k == 0 ? account.start(stored) : account.add(stored);
    }
    for (std::size_t b = 0; k + 1 < samples && b < commands.breaks().size(); ++b) {
      commands.at(k, b, ode.command());
      integrator.input_changed(true);
      const double end = b + 1 < commands.breaks().size() ? commands.breaks()[b + 1] : 1.0;
      const double from = commands.breaks()[b];
      const int pieces = plates.any() ? pieces_of((end - from) * commands.period()) : 1;
      for (int piece = 1; piece <= pieces; ++piece) {
        const double part = from + (end - from) * piece / pieces;
        integrator.advance(t0 + (static_cast<double>(k) + part) * commands.period());
        plates.add(t0 + (static_cast<double>(k) + part) * commands.period(), integrator.state().data());
      }
    }
  }
  if (options.energy) {
    const double work = x[nx];
    const double dissipated = x[nx + 1];
    result.energy_error = account.error(work, dissipated);
    result.energy_exchanged = account.exchanged(work, dissipated);
  }
  result.events = integrator.events();
  result.summary = integrator.summary();
  return result;
}

}  // namespace plumbline::integrate
