#include "tests/benchmark/replay.h"

#include <cmath>
#include <ctime>

#include "simulator/integrate/plant_ode.h"

namespace plumbline::benchmarks {
namespace {

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

Course simulate(const Replay& replay, model::Plant& plant, const integrate::Options& options) {
  integrate::PlantOde ode(plant, false, false);
  integrate::Integrator integrator(ode, options);
  Course course;
  course.states.resize(plant.states(), replay.commands.cols());
  integrator.start(0.0, replay.start);
  const double begin = processor_time();
  for (Eigen::Index k = 0; k < replay.commands.cols(); ++k) {
    for (Eigen::Index m = 0; m < replay.commands.rows(); ++m) {
      ode.command()[m] = replay.commands(m, k);
    }
    integrator.input_changed(true);
    integrator.advance(replay.period * static_cast<double>(k + 1));
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
