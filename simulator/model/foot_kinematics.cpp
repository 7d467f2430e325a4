#include "simulator/model/foot_kinematics.h"

#include "simulator/trace/error.h"

namespace plumbline::model {

FootKinematics::FootKinematics(const Plant& plant) : plant_(plant), mechanism_(plant.model().skeleton) {
  // Joint positions are affine in z.
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const Eigen::VectorXd at_zero = plant.joint_positions(x.data());
  tree_map_.resize(at_zero.size(), plant.positions());
  for (int i = 0; i < plant.positions(); ++i) {
    x[i] = 1.0;
    tree_map_.col(i) = plant.joint_positions(x.data()) - at_zero;
    x[i] = 0.0;
  }
}

PointMotion FootKinematics::foot(int foot, const double* x) {
  const Foot& it = plant_.model().feet.at(static_cast<std::size_t>(foot));
  const int n = plant_.positions();
  const Eigen::Map<const Eigen::VectorXd> w(x + n, n);
  q_ = plant_.joint_positions(x);
  v_ = tree_map_ * w;
  mechanism_.evaluate(q_, v_, M_, h_);
  const TreeDynamics& tree = mechanism_.tree();
  const int body = mechanism_.tree_body(it.body);
  PointMotion point;
  point.position = tree.station(body, it.point);
  point.velocity = tree.station_velocity(body, point.position);
  Eigen::Matrix3Xd slope;
  tree.station_velocity_slope(body, point.position, slope);
  point.bias = slope * v_;
  Eigen::Matrix3Xd by_joints(3, q_.size());
  Eigen::VectorXd row(q_.size());
  for (int k = 0; k < 3; ++k) {
    row.setZero();
    tree.add_force(body, point.position, Eigen::Vector3d::Unit(k), row);
    by_joints.row(k) = row.transpose();
  }
  point.jacobian = by_joints * tree_map_;
  return point;
}

int FootKinematics::index_of(const std::string& foot) const {
  const std::vector<Foot>& feet = plant_.model().feet;
  for (std::size_t f = 0; f < feet.size(); ++f) {
    if (feet[f].name == foot) {
      return static_cast<int>(f);
    }
  }
  throw InputError(plant_.model().file + ": no foot is named '" + foot + "'");
}

Eigen::RowVectorXd FootKinematics::row_of(const std::string& name) const {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
  Eigen::RowVectorXd row(plant_.positions());
  const double at_zero = plant_.position_of(name, x.data());
  for (int i = 0; i < plant_.positions(); ++i) {
    x[i] = 1.0;
    row[i] = plant_.position_of(name, x.data()) - at_zero;
    x[i] = 0.0;
  }
  return row;
}

}  // namespace plumbline::model
