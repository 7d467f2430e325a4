#include "tests/benchmark/recorded_hop.h"

#include <cmath>
#include <stdexcept>

#include "tests/control/gait/mabel_hops.h"

namespace plumbline::benchmarks {
namespace {

constexpr double kBeforeLanding = 0.05;  // s, in the air
constexpr int kHop = 1;                  // the second: the first landing is that of the drop

/// The commands of a run's samples, by the model's motors.
Eigen::MatrixXd commands_of(const Table& trace, const model::Model& model) {
  Eigen::MatrixXd commands(static_cast<Eigen::Index>(model.motors.size()), trace.rows());
  for (std::size_t m = 0; m < model.motors.size(); ++m) {
    commands.row(static_cast<Eigen::Index>(m)) = trace.find("u_" + model.motors[m].name)->values.transpose();
  }
  return commands;
}

}  // namespace

Replay record_hop(const std::string& model_file) {
  Replay hop;
  hop.model = validation::mabel(model_file);
  const run::LoadedScenario loaded = validation::hopping(hop.model);
  const validation::GaitRun run = validation::hops_of(loaded, kHop + 2, 1e-6);
  if (run.run.fell) {
    throw std::runtime_error(model_file + ": does not hop: " + run.run.end);
  }
  const double period = loaded.controller->period;
  const auto sample = [&](std::size_t h) {
    return static_cast<Eigen::Index>(std::llround((run.cycles.at(h).end - kBeforeLanding) / period));
  };
  const Eigen::Index first = sample(kHop - 1);
  const Eigen::MatrixXd all = commands_of(run.run.trace, hop.model);
  hop.period = period;
  model::Plant plant(hop.model, {});
  integrate::Options integrator = run::SampledOptions().integrator;
  integrator.set_tolerance(1e-6);
  Replay before = hop;
  before.start = run::state_at_start(loaded.model, loaded.scenario);
  before.commands = all.leftCols(first);
  hop.start = simulate(before, plant, integrator).states.rightCols(1);
  hop.commands = all.middleCols(first, sample(kHop) - first);
  return hop;
}

}  // namespace plumbline::benchmarks
