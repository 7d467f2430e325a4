#include "simulator/model/positions_from.h"

#include <algorithm>

namespace plumbline::model {
namespace {

constexpr double kNoFloor = 1e-9;
// Of a stretch of zero against the channels: never fights a sensor.
constexpr double kWeak = 1e-6;
// Of what opens a loop, the same.
constexpr double kStiff = 1e3;

}  // namespace

Observation observe_sensor(const Plant& plant, int sensor) {
  const Sensor& of = plant.model().sensors[static_cast<std::size_t>(sensor)];
  Observation seen{plant.output_map().row(sensor), plant.output_offset()[sensor],
                   std::max(of.floor(), kNoFloor)};
  for (const EffectUse& use : plant.model().effects) {
    const auto* law = dynamic_cast<const effects::SensorLaw*>(use.law.get());
    if (law != nullptr && use.at == of.name) {  // a straight line: an offset or a scale
      const effects::Values p = use.numbers();
      const double at_zero = law->reading(0.0, p.data());
      const double slope = law->reading(1.0, p.data()) - at_zero;
      seen.row *= slope;
      seen.offset = slope * seen.offset + at_zero;
    }
  }
  return seen;
}

Observation observe_place(const Plant& plant, const std::string& name, double deviation) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  Observation seen{Eigen::RowVectorXd(plant.positions()), plant.position_of(name, x.data()), deviation};
  for (int i = 0; i < plant.positions(); ++i) {
    x[i] = 1.0;
    seen.row[i] = plant.position_of(name, x.data()) - seen.offset;
    x[i] = 0.0;
  }
  return seen;
}

PositionsFrom::PositionsFrom(const Plant& plant, const std::vector<Observation>& channels)
    : positions_(plant.positions()),
      stretches_(plant.stretch_map().rows()),
      offsets_(static_cast<Eigen::Index>(channels.size())),
      weights_(static_cast<Eigen::Index>(channels.size())),
      closure_(plant.own_closure()) {
  const Eigen::Index n = offsets_.size();
  loops_ = closure_ != nullptr ? closure_->size() : 0;
  Eigen::MatrixXd C(n + stretches_ + loops_, positions_);
  for (Eigen::Index c = 0; c < n; ++c) {
    const Observation& channel = channels[static_cast<std::size_t>(c)];
    offsets_[c] = channel.offset;
    weights_[c] = 1.0 / channel.deviation;
    C.row(c) = weights_[c] * channel.row;
  }
  const double largest = n > 0 ? C.topRows(n).cwiseAbs().maxCoeff() : 1.0;
  C.middleRows(n, stretches_) = kWeak * largest * plant.stretch_map();
  if (loops_ > 0) {
    rows_ = C.topRows(n + stretches_);
    C.bottomRows(loops_) = kStiff * largest * closure_->jacobian(closure_->home());
  }
  solver_.compute(C);
}

Eigen::VectorXd PositionsFrom::deviations() const { return solver_.pseudoInverse().rowwise().norm(); }

Eigen::VectorXd PositionsFrom::deviations_unstretched() const {
  return solver_.pseudoInverse().leftCols(offsets_.size()).rowwise().norm();
}

Eigen::MatrixXd PositionsFrom::right_side(const Eigen::MatrixXd& weighted) const {
  Eigen::MatrixXd right = Eigen::MatrixXd::Zero(weighted.rows() + stretches_, weighted.cols());
  right.topRows(weighted.rows()) = weighted;
  return right;
}

Eigen::MatrixXd PositionsFrom::solve(const Eigen::MatrixXd& weighted) const {
  return solver_.solve(right_side(weighted));
}

Eigen::MatrixXd PositionsFrom::positions(const Eigen::MatrixXd& values) const {
  const Eigen::MatrixXd weighted = weights_.asDiagonal() * (values.colwise() - offsets_);
  if (closure_ == nullptr) {
    return solve(weighted);
  }
  const Eigen::MatrixXd right = right_side(weighted);
  Eigen::MatrixXd found(positions_, values.cols());
  Eigen::VectorXd z = closure_->home();
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    if (!closure_->close(rows_, right.col(k), z)) {
      z = closure_->home();  // noise has led it astray: once more from where the loops are known to close
      closure_->close(rows_, right.col(k), z);
    }
    found.col(k) = z;
  }
  return found;
}

Eigen::MatrixXd PositionsFrom::rates(const Eigen::MatrixXd& values, const Eigen::MatrixXd& positions) const {
  const Eigen::MatrixXd weighted = weights_.asDiagonal() * values;
  if (closure_ == nullptr) {
    return solve(weighted);
  }
  const Eigen::MatrixXd right = right_side(weighted);
  Eigen::MatrixXd found(positions_, values.cols());
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    found.col(k) = closure_->velocities(rows_, right.col(k), positions.col(k));
  }
  return found;
}

}  // namespace plumbline::model
