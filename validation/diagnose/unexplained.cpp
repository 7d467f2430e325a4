#include "validation/diagnose/unexplained.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "validation/inverse_model/inverse_model.h"

namespace plumbline::validation {
namespace {

constexpr double kTurn = 6.283185307179586;

/// Bins of equal numbers of samples along x; the share of y's variance between the bins' means.
Dependence depend(const std::string& variable, const std::string& unit, const Eigen::VectorXd& x,
                  const Eigen::VectorXd& y, Eigen::Index bins) {
  Dependence dependence{variable, unit, 0.0, {}, {}};
  std::vector<Eigen::Index> order(static_cast<std::size_t>(x.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](Eigen::Index a, Eigen::Index b) { return x[a] < x[b]; });
  const double mean = y.mean();
  const double total = (y.array() - mean).square().sum();
  double between = 0.0;
  for (Eigen::Index b = 0; b < bins; ++b) {
    const Eigen::Index from = x.size() * b / bins;
    const Eigen::Index to = x.size() * (b + 1) / bins;
    double sx = 0.0;
    double sy = 0.0;
    for (Eigen::Index i = from; i < to; ++i) {
      sx += x[order[static_cast<std::size_t>(i)]];
      sy += y[order[static_cast<std::size_t>(i)]];
    }
    const auto n = static_cast<double>(std::max<Eigen::Index>(1, to - from));
    dependence.center.push_back(sx / n);
    dependence.mean.push_back(sy / n);
    between += n * (sy / n - mean) * (sy / n - mean);
  }
  dependence.share = total > 0.0 ? between / total : 0.0;
  return dependence;
}

std::string in_words(const Dependence& strongest) {
  if (strongest.share < 0.1) {
    return "follows none of position, velocity, load, time and motor angle";
  }
  const bool rises = strongest.mean.back() > strongest.mean.front();
  if (strongest.variable == "time") {
    return rises ? "grows over the trial" : "falls over the trial";
  }
  if (strongest.variable == "motor angle") {
    return "repeats with the motor's turn";
  }
  if (strongest.variable == "direction") {
    return "depends on the direction of motion";
  }
  return "depends on " + strongest.variable;
}

UnexplainedForce analyse(const NeededForce& force, const Trial& trial, bool angular) {
  const Eigen::Index bins = 12;
  UnexplainedForce out;
  out.trial = trial.name;
  out.motor = force.motor;
  out.unit = force.unit;
  out.role = trial.role;
  const Eigen::VectorXd left = force.recorded - force.needed;
  out.rms = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  out.relative = left.norm() / std::max(force.recorded.norm(), 1e-300);
  const std::string x = angular ? "rad" : "m";
  const Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(left.size(), 0.0, static_cast<double>(left.size()) * trial.period);
  out.dependences = {depend("position", x, force.position, left, bins),
                     depend("velocity", x + "/s", force.velocity, left, bins),
                     depend("direction", "1", force.velocity.array().sign().matrix(), left, 2),
                     depend("load", force.unit, force.recorded, left, bins),
                     depend("time", "s", time, left, bins)};
  if (angular) {
    const Eigen::VectorXd turn =
        force.position.unaryExpr([](double q) { return q - kTurn * std::floor(q / kTurn); });
    out.dependences.push_back(depend("motor angle", "rad", turn, left, 4 * bins));
  }
  std::stable_sort(out.dependences.begin(), out.dependences.end(),
                   [](const Dependence& a, const Dependence& b) { return a.share > b.share; });
  out.words = in_words(out.dependences.front());
  return out;
}

}  // namespace

std::vector<UnexplainedForce> unexplained_forces(const model::Model& model, const Data& data) {
  std::vector<UnexplainedForce> all;
  for (const Trial& trial : data.trials) {
    const InverseModel inverse = inverse_model(model, trial, {});
    for (const NeededForce& force : inverse.motors) {
      const model::Motor* motor = model.find_motor(force.motor);
      all.push_back(analyse(force, trial, motor == nullptr || motor->angular));
    }
  }
  return all;
}

}  // namespace plumbline::validation
