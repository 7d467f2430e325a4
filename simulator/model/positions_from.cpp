#include "simulator/model/positions_from.h"

#include <algorithm>

#include "simulator/model/point_sensors.h"
#include "simulator/model/rotation_vector.h"

namespace plumbline::model {
namespace {

constexpr double kNoFloor = 1e-9;
// Of a stretch of zero against the channels: never fights a sensor.
constexpr double kWeak = 1e-6;
// Of what opens a loop, the same.
constexpr double kStiff = 1e3;

/// Steps from one sample to the next, and how small the last one is, m and rad.
constexpr int kMostSteps = 20;
constexpr double kLastStep = 1e-12;

}  // namespace

class PoseRows {
 public:
  PoseRows(const Plant& plant, const std::vector<Observation>& channels)
      : tree_(plant.tree()), S_(plant.joint_map()) {
    q0_ = plant.joint_positions(Eigen::VectorXd::Zero(plant.states()).eval().data());
    for (std::size_t c = 0; c < channels.size(); ++c) {
      if (channels[c].sensor >= 0) {
        const Sensor& sensor = plant.model().sensors[static_cast<std::size_t>(channels[c].sensor)];
        seen_.push_back(
            {static_cast<Eigen::Index>(c), plant.tree_body_of_sensor(channels[c].sensor), sensor});
      }
    }
  }
  bool empty() const { return seen_.empty(); }

  /// Rows of the channels in C, and what they show at z less what was measured, in `missing`.
  void look(const Eigen::VectorXd& z, const Eigen::VectorXd& values, Eigen::MatrixXd& C,
            Eigen::VectorXd& missing) {
    tree_.place(S_ * z + q0_);
    for (const Seen& one : seen_) {
      const Eigen::Index c = one.channel;
      const int axis = one.sensor.axis;
      C.row(c) = point_rows(tree_, one.body, one.sensor).row(axis) * S_;
      const Eigen::Vector3d here = point_reading(tree_, one.body, one.sensor, {});
      missing[c] = one.sensor.reading == PointReading::orientation
                       ? turn_between(here, values.segment<3>(c - axis))[axis]
                       : values[c] - here[axis];
    }
  }

  /// An orientation's rates are those of its rotation vector: as the turn's about the sensor's axes.
  void turn_rates(const Eigen::VectorXd& values, Eigen::VectorXd& rates) const {
    for (const Seen& one : seen_) {
      if (one.sensor.reading == PointReading::orientation && one.sensor.axis == 0) {
        rates.segment<3>(one.channel) =
            right_jacobian(values.segment<3>(one.channel)) * rates.segment<3>(one.channel).eval();
      }
    }
  }

 private:
  struct Seen {
    Eigen::Index channel;
    int body;
    Sensor sensor;
  };
  TreeDynamics tree_;
  Eigen::MatrixXd S_;
  Eigen::VectorXd q0_;
  std::vector<Seen> seen_;
};

namespace {

/// As it is at z = 0.
Observation observe_pose(const Plant& plant, int sensor) {
  const Sensor& of = plant.model().sensors[static_cast<std::size_t>(sensor)];
  Observation seen{Eigen::RowVectorXd::Zero(plant.positions()), 0.0, std::max(of.floor(), kNoFloor), sensor};
  TreeDynamics tree = plant.tree();
  tree.place(plant.joint_positions(Eigen::VectorXd::Zero(plant.states()).eval().data()));
  seen.row = point_rows(tree, plant.tree_body_of_sensor(sensor), of).row(of.axis) * plant.joint_map();
  seen.offset = point_reading(tree, plant.tree_body_of_sensor(sensor), of, {})[of.axis];
  return seen;
}

}  // namespace

Observation observe_sensor(const Plant& plant, int sensor) {
  const Sensor& of = plant.model().sensors[static_cast<std::size_t>(sensor)];
  if (of.shows_pose()) {
    return observe_pose(plant, sensor);
  }
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
  auto poses = std::make_shared<PoseRows>(plant, channels);
  poses_ = poses->empty() ? nullptr : std::move(poses);
  Eigen::MatrixXd C(n + stretches_ + loops_, positions_);
  for (Eigen::Index c = 0; c < n; ++c) {
    const Observation& channel = channels[static_cast<std::size_t>(c)];
    offsets_[c] = channel.offset;
    weights_[c] = 1.0 / channel.deviation;
    C.row(c) = weights_[c] * channel.row;
  }
  const double largest = n > 0 ? C.topRows(n).cwiseAbs().maxCoeff() : 1.0;
  C.middleRows(n, stretches_) = kWeak * largest * plant.stretch_map();
  if (loops_ > 0 || poses_ != nullptr) {
    rows_ = C.topRows(n + stretches_);
  }
  if (loops_ > 0) {
    C.bottomRows(loops_) = largest * closure_->jacobian(closure_->home());
    for (Eigen::Index i = 0; i < loops_; ++i) {
      const bool stretches = plant.lets_stretch(closure_->loop_of(static_cast<int>(i)).name);
      C.row(n + stretches_ + i) *= stretches ? kWeak : kStiff;
    }
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

// Near z each pose's channel is a line: value = row (z + dz) + offset.
Eigen::VectorXd PositionsFrom::pose_at(const Eigen::VectorXd& values, Eigen::VectorXd z) const {
  Eigen::MatrixXd C = weights_.cwiseInverse().asDiagonal() * rows_.topRows(offsets_.size());
  Eigen::MatrixXd weighted = rows_;
  for (int step = 0; step < kMostSteps; ++step) {
    Eigen::VectorXd missing = values - offsets_ - C * z;
    poses_->look(z, values, C, missing);
    weighted.topRows(offsets_.size()) = weights_.asDiagonal() * C;
    const Eigen::VectorXd right = right_side(weights_.cwiseProduct(missing + C * z));
    const Eigen::VectorXd before = z;
    if (closure_ != nullptr) {
      closure_->close(weighted, right, z);
    } else {
      z = weighted.completeOrthogonalDecomposition().solve(right);
    }
    if (!((z - before).norm() > kLastStep)) {
      break;
    }
  }
  return z;
}

Eigen::MatrixXd PositionsFrom::positions(const Eigen::MatrixXd& values) const {
  Eigen::MatrixXd found(positions_, values.cols());
  Eigen::VectorXd z = closure_ != nullptr ? closure_->home() : Eigen::VectorXd::Zero(positions_).eval();
  if (poses_ != nullptr) {
    for (Eigen::Index k = 0; k < values.cols(); ++k) {
      z = pose_at(values.col(k), z);
      found.col(k) = z;
    }
    return found;
  }
  const Eigen::MatrixXd weighted = weights_.asDiagonal() * (values.colwise() - offsets_);
  if (closure_ == nullptr) {
    return solve(weighted);
  }
  const Eigen::MatrixXd right = right_side(weighted);
  for (Eigen::Index k = 0; k < values.cols(); ++k) {
    if (!closure_->close(rows_, right.col(k), z)) {
      z = closure_->home();  // noise has led it astray: once more from where the loops are known to close
      closure_->close(rows_, right.col(k), z);
    }
    found.col(k) = z;
  }
  return found;
}

Eigen::MatrixXd PositionsFrom::rates(const Eigen::MatrixXd& rates, const Eigen::MatrixXd& positions,
                                     const Eigen::MatrixXd& values) const {
  if (closure_ == nullptr && poses_ == nullptr) {
    return solve(weights_.asDiagonal() * rates);
  }
  Eigen::MatrixXd rows = rows_;
  Eigen::MatrixXd found(positions_, rates.cols());
  for (Eigen::Index k = 0; k < rates.cols(); ++k) {
    Eigen::VectorXd seen = rates.col(k);
    if (poses_ != nullptr) {
      Eigen::MatrixXd C = weights_.cwiseInverse().asDiagonal() * rows.topRows(offsets_.size());
      Eigen::VectorXd missing(offsets_.size());
      poses_->look(positions.col(k), values.col(k), C, missing);
      poses_->turn_rates(values.col(k), seen);
      rows.topRows(offsets_.size()) = weights_.asDiagonal() * C;
    }
    const Eigen::VectorXd right = right_side(weights_.cwiseProduct(seen));
    found.col(k) = closure_ != nullptr ? closure_->velocities(rows, right, positions.col(k))
                                       : rows.completeOrthogonalDecomposition().solve(right).eval();
  }
  return found;
}

}  // namespace plumbline::model
