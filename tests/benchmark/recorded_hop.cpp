#include "tests/benchmark/recorded_hop.h"

#include <cmath>
#include <stdexcept>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/hopping/hop_run.h"
#include "validation/hopping/hopping_file.h"

namespace plumbline::benchmarks {
namespace {

constexpr double kBeforeLanding = 0.05;  // s, in the air
constexpr int kHop = 1;                  // the second: the first landing is that of the drop

/// The commands of a run's samples, by the model's motors.
Eigen::MatrixXd commands_of(const validation::HopRun& run, const model::Model& model) {
  Eigen::MatrixXd commands(static_cast<Eigen::Index>(model.motors.size()),
                           run.trace.columns[0].values.size());
  for (std::size_t m = 0; m < model.motors.size(); ++m) {
    for (const Column& column : run.trace.columns) {
      if (column.name == "u_" + model.motors[m].name) {
        commands.row(static_cast<Eigen::Index>(m)) = column.values.transpose();
      }
    }
  }
  return commands;
}

}  // namespace

Replay record_hop(const std::string& model_file) {
  const std::string folder = PLUMBLINE_ROOT "/robots/mabel/";
  Replay hop;
  hop.model = model::read_model(folder + model_file, model::known_effects());
  const controllers::HoppingConfig config = validation::read_hopping(folder + "hopping.yaml");
  validation::HopOptions options;
  options.integrator.relative_tolerance = 1e-6;
  options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-8);
  options.hops = kHop + 2;
  options.trace = true;
  const validation::HopRun run = validation::hop(hop.model, config, {}, options);
  if (run.fell) {
    throw std::runtime_error(model_file + ": does not hop: " + run.end);
  }
  const auto sample = [&](std::size_t h) {
    return static_cast<Eigen::Index>(std::llround((run.hops.at(h).landing - kBeforeLanding) / config.period));
  };
  // hops[h] ends at its landing.
  const Eigen::Index first = sample(kHop - 1);
  const Eigen::MatrixXd all = commands_of(run, hop.model);
  hop.period = config.period;
  model::Plant plant(hop.model, {});
  Replay before = hop;
  before.start = validation::start_state(plant, config, {});
  before.commands = all.leftCols(first);
  hop.start = simulate(before, plant, options.integrator).states.rightCols(1);
  hop.commands = all.middleCols(first, sample(kHop) - first);
  return hop;
}

}  // namespace plumbline::benchmarks
