#include "validation/identify/predict/plate_slopes.h"

#include <utility>

namespace plumbline::validation {
namespace {

/// Small against the depth of a foot in the ground (1 mm) and its speeds.
constexpr double kPositionStep = 1e-7;  // m, rad, and whatever else a state is
constexpr double kVelocityStep = 1e-5;  // m/s, rad/s

}  // namespace

PlateSlopes::PlateSlopes(model::Plant& plant, std::vector<model::ParameterId> parameters,
                         Eigen::VectorXd steps)
    : plant_(plant),
      parameters_(std::move(parameters)),
      steps_(std::move(steps)),
      any_(plant.model().has_force_plate()) {}

void PlateSlopes::begin() {
  time_ = 0.0;
  impulse_.setZero(plant_.sensors(), plant_.states() + steps_.size());
}

void PlateSlopes::add(double length, const Eigen::VectorXd& middle, const Eigen::MatrixXd& mean_S) {
  time_ += length;
  impulse_ += length * at(middle, mean_S);
}

Eigen::VectorXd PlateSlopes::forces(const Eigen::VectorXd& x) {
  Eigen::VectorXd y(plant_.sensors());
  plant_.outputs(x.data(), y.data());
  for (int s = 0; s < plant_.sensors(); ++s) {
    y[s] *= plant_.model().sensors[static_cast<std::size_t>(s)].is_force_plate() ? 1.0 : 0.0;
  }
  return y;
}

Eigen::MatrixXd PlateSlopes::at(const Eigen::VectorXd& x, const Eigen::MatrixXd& S) {
  const Eigen::Index nz = plant_.positions();
  Eigen::MatrixXd C(plant_.sensors(), x.size());
  Eigen::VectorXd moved = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double step = i >= nz && i < 2 * nz ? kVelocityStep : kPositionStep;
    moved[i] = x[i] + step;
    const Eigen::VectorXd above = forces(moved);
    moved[i] = x[i] - step;
    C.col(i) = (above - forces(moved)) / (2.0 * step);
    moved[i] = x[i];
  }
  Eigen::MatrixXd slope = C * S;
  const Eigen::Index first = S.cols() - static_cast<Eigen::Index>(parameters_.size());
  for (std::size_t p = 0; p < parameters_.size(); ++p) {
    const model::EffectUse& use = plant_.model().effects[static_cast<std::size_t>(parameters_[p].effect)];
    if (use.law->sits_at(effects::Place::foot)) {
      slope.col(first + static_cast<Eigen::Index>(p)) += by_parameter(p, x);
    }
  }
  return slope;
}

Eigen::VectorXd PlateSlopes::by_parameter(std::size_t p, const Eigen::VectorXd& x) {
  const double here = plant_.value(parameters_[p]);
  const double step = steps_[static_cast<Eigen::Index>(p)];
  const Eigen::VectorXd before = forces(x);
  plant_.set_value(parameters_[p], here + step);
  const Eigen::VectorXd behind = forces(x);
  plant_.set_value(parameters_[p], here);
  return (behind - before) / step;
}

}  // namespace plumbline::validation
