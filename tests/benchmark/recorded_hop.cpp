#include "tests/benchmark/recorded_hop.h"

#include <cmath>
#include <ctime>
#include <stdexcept>

#include "simulator/integrate/plant_ode.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/hopping/hop_run.h"
#include "validation/hopping/hopping_file.h"

namespace plumbline::benchmarks {
namespace {

constexpr double kBeforeLanding = 0.05;  // s, in the air
constexpr int kHop = 1;                  // the second: the first landing is that of the drop

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

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

RecordedHop record_hop(const std::string& model_file) {
  const std::string folder = PLUMBLINE_ROOT "/robots/mabel/";
  RecordedHop hop;
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
  RecordedHop before = hop;
  before.start = validation::start_state(plant, config, {});
  before.commands = all.leftCols(first);
  hop.start = simulate(before, plant, options.integrator).states.rightCols(1);
  hop.commands = all.middleCols(first, sample(kHop) - first);
  return hop;
}

Course simulate(const RecordedHop& hop, model::Plant& plant, const integrate::Options& options) {
  integrate::PlantOde ode(plant, false, false);
  integrate::Integrator integrator(ode, options);
  Course course;
  course.states.resize(plant.states(), hop.commands.cols());
  integrator.start(0.0, hop.start);
  const double begin = processor_time();
  for (Eigen::Index k = 0; k < hop.commands.cols(); ++k) {
    for (Eigen::Index m = 0; m < hop.commands.rows(); ++m) {
      ode.command()[m] = hop.commands(m, k);
    }
    integrator.input_changed(true);
    integrator.advance(hop.period * static_cast<double>(k + 1));
    course.states.col(k) = integrator.state();
  }
  course.seconds = processor_time() - begin;
  course.summary = integrator.summary();
  return course;
}

double trajectory_error(const Course& course, const Course& reference, model::Plant& plant) {
  const Eigen::Index n = plant.positions();
  const Eigen::VectorXd command = Eigen::VectorXd::Zero(plant.motors());
  const Eigen::VectorXd middle = reference.states.topRows(n).rowwise().mean();
  Eigen::VectorXd xdot(plant.states());
  Eigen::Array2d missed = Eigen::Array2d::Zero();
  Eigen::Array2d moved = Eigen::Array2d::Zero();
  for (Eigen::Index k = 0; k < reference.states.cols(); ++k) {
    const Eigen::VectorXd x = reference.states.col(k);
    const Eigen::VectorXd error = course.states.col(k) - x;
    plant.rate(x.data(), command.data(), xdot.data());
    const Eigen::MatrixXd& M = plant.mass_matrix();
    const auto energy = [&](const Eigen::VectorXd& v) { return v.dot(M * v); };
    missed += Eigen::Array2d(energy(error.head(n)), energy(error.segment(n, n)));
    moved += Eigen::Array2d(energy(x.head(n) - middle), energy(x.segment(n, n)));
  }
  return (missed / moved).sqrt().maxCoeff();
}

double worst_coordinate(const Course& course, const Course& reference, const model::Plant& plant) {
  double worst = 0.0;
  for (Eigen::Index i = 0; i < 2 * plant.positions(); ++i) {
    const Eigen::ArrayXd wanted = reference.states.row(i).transpose().array();
    const double range = std::sqrt((wanted - wanted.mean()).square().mean());
    const Eigen::ArrayXd found = course.states.row(i).transpose().array();
    const double error = std::sqrt((found - wanted).square().mean()) / range;
    worst = error > worst || std::isnan(error) ? error : worst;
  }
  return worst;
}

}  // namespace plumbline::benchmarks
