// Poses of links against the plant's own kinematics (Rodrigues' formula on the tree) and a closed form.
#include "simulator/model/body_poses.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"

namespace plumbline::model {
namespace {

TEST(BodyPoses, FeetAreWhereThePlantTouchesTheGround) {
  const Model mabel = read_model(PLUMBLINE_ROOT "/robots/mabel/mabel.yaml", known_effects());
  Plant plant(mabel, {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  for (int trial = 0; trial < 20; ++trial) {
    for (int i = 0; i < plant.positions(); ++i) {
      x[i] = std::sin(1.0 + 3.7 * i + 2.3 * trial);
    }
    const std::vector<Eigen::Isometry3d> poses = body_poses(mabel.skeleton, plant.joint_positions(x.data()));
    const std::vector<Touch> touches = plant.touches(x.data());
    for (std::size_t f = 0; f < mabel.feet.size(); ++f) {
      const Foot& foot = mabel.feet[f];
      EXPECT_LT((poses[static_cast<std::size_t>(foot.body)] * foot.point - touches[f].position).norm(),
                1e-13);
    }
  }
}

// The pendulum's arm hangs 1 m above the ground and turns about y: positive carries it backward.
TEST(BodyPoses, APendulumTurnsAboutItsAxis) {
  const Skeleton skeleton = read_skeleton(PLUMBLINE_ROOT "/tests/robots/pendulum/pendulum_drive.urdf");
  const double angle = 0.7;
  const std::vector<Eigen::Isometry3d> poses = body_poses(skeleton, Eigen::VectorXd::Constant(1, angle));
  const Eigen::Vector3d tip = poses.back() * Eigen::Vector3d(0.0, 0.0, -0.6);
  EXPECT_LT((tip - Eigen::Vector3d(-0.6 * std::sin(angle), 0.0, 1.0 - 0.6 * std::cos(angle))).norm(), 1e-14);
}

}  // namespace
}  // namespace plumbline::model
