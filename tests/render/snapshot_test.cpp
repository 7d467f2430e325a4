// What one moment shows: between samples, of springs and of cables.
#include "simulator/render/snapshot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/render/view.h"

namespace plumbline::render {
namespace {

class SnapshotTest : public testing::Test {
 protected:
  SnapshotTest()
      : plant_(model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", model::known_effects()),
               {}) {
    motion_.time = Eigen::Vector2d(1.0, 2.0);
    motion_.positions = Eigen::MatrixXd::Zero(plant_.positions(), 2);
    motion_.foot_forces.assign(2, Eigen::Matrix3Xd::Zero(3, 2));
    motion_.foot_forces[1](2, 1) = 400.0;
    motion_.phase = {3, 5};
  }
  /// Index of an independent position by its name.
  Eigen::Index index(const std::string& name) const {
    const std::vector<std::string> names = plant_.state_names();
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i] == "position of " + name) return static_cast<Eigen::Index>(i);
    }
    ADD_FAILURE() << name;
    return 0;
  }
  std::size_t body(const std::string& name) const {
    return static_cast<std::size_t>(plant_.model().body_index(name));
  }

  model::Plant plant_;
  Motion motion_;
};

TEST_F(SnapshotTest, LiesOnTheLineBetweenSamplesAndStaysInside) {
  motion_.positions(index("hip_x"), 1) = 0.4;
  const Snapshots snapshots(plant_, motion_);
  const Snapshot middle = snapshots.at(1.25);
  EXPECT_NEAR(middle.poses[body("torso_link")].translation().x(), 0.1, 1e-12);
  EXPECT_NEAR(middle.pushes[1].force.z(), 100.0, 1e-12);
  EXPECT_EQ(middle.phase, 3);
  EXPECT_EQ(snapshots.at(1.75).phase, 5);
  EXPECT_NEAR(snapshots.at(7.0).poses[body("torso_link")].translation().x(), 0.4, 1e-12);
  EXPECT_NEAR(snapshots.at(-7.0).poses[body("torso_link")].translation().x(), 0.0, 1e-12);
}

// Equation 6: mLA = -23.53 leg angle. A motor 0.2353 rad ahead of a leg that stands at zero means that a
// rigid cable would hold the leg at -0.01 rad: the leg is 0.01 rad beyond.
TEST_F(SnapshotTest, StretchIsTheWayFromWhereARigidCableWouldHoldTheLink) {
  motion_.positions(index("mLA_left"), 0) = 0.2353;
  const Snapshots snapshots(plant_, motion_);
  const Snapshot shot = snapshots.at(1.0);
  ASSERT_EQ(shot.stretches.size(), 4U);
  EXPECT_NEAR(shot.stretches[0].amount, 0.01, 1e-12);
  EXPECT_TRUE(shot.stretches[0].turns);
  // At the hip; the leg hangs, the axis is -y.
  const Eigen::Matrix3d R = shot.stretches[0].X_WJ.linear();
  EXPECT_LT((R.col(0) - Eigen::Vector3d(0, 0, -1)).norm(), 1e-12);
  EXPECT_LT((R.col(2) - Eigen::Vector3d(0, -1, 0)).norm(), 1e-12);
  EXPECT_NEAR(shot.stretches[2].amount, 0.0, 1e-12);
}

// Equation 7: mLS = 31.42 leg shape, and the knee turns -2 leg shape.
TEST_F(SnapshotTest, AtTheKneeTheStretchIsTwiceThatOfTheLegShape) {
  motion_.positions(index("mLS_left"), 0) = 0.3142;
  const Snapshot shot = Snapshots(plant_, motion_).at(1.0);
  EXPECT_NEAR(shot.stretches[1].amount, 0.02, 1e-12);
}

TEST_F(SnapshotTest, ASpringColoursTheLinkThatItLoads) {
  motion_.positions(index("bsp_right"), 0) = -0.3;
  motion_.positions(index("bsp_right"), 1) = 0.5;
  const Snapshots snapshots(plant_, motion_);
  const Snapshot shot = snapshots.at(1.0);
  EXPECT_NEAR(shot.spring[body("shin_right")], 0.3, 1e-12);
  EXPECT_EQ(shot.spring[body("shin_left")], 0.0);
  EXPECT_NEAR(snapshots.largest_spring(), 0.5, 1e-12);
  EXPECT_TRUE(snapshots.springs_turn());
}

// Deflection counts from the spring's rest, on the side on which it acts.
TEST(SnapshotOfAHopper, ASpringIsDeflectedFromItsRest) {
  const model::Plant plant(
      model::read_model(PLUMBLINE_ROOT "/robots/hopper/hopper.yaml", model::known_effects()), {});
  Motion motion;
  motion.time = Eigen::Vector2d(0.0, 1.0);
  motion.positions = Eigen::MatrixXd::Zero(plant.positions(), 2);
  const Snapshot shot = Snapshots(plant, motion).at(0.0);
  // The gas spring at the carriage rests at 0.049 m, the leg's at 0.
  EXPECT_NEAR(shot.spring[static_cast<std::size_t>(plant.model().body_index("slider"))], 0.049, 1e-12);
  EXPECT_EQ(shot.spring[static_cast<std::size_t>(plant.model().body_index("foot"))], 0.0);
  EXPECT_FALSE(Snapshots(plant, motion).springs_turn());
}

// Every corner of every part lies inside the camera's pyramid, whatever the camera.
TEST_F(SnapshotTest, EveryCameraKeepsTheRobotInThePicture) {
  motion_.positions(index("hip_x"), 1) = 1.5;
  motion_.positions(index("hip_z"), 1) = 0.4;
  const Snapshots snapshots(plant_, motion_);
  const Figure figure = figure_of(plant_.model(), {});
  const double shape = 16.0 / 9.0;
  for (const Camera camera : {Camera::side, Camera::follow, Camera::boom}) {
    const Director director(figure, plant_.model().skeleton, snapshots, camera, shape, 1.0, 2.0);
    for (const double time : {1.0, 1.5, 2.0}) {
      const View view = director.view(time);
      const Eigen::Vector3d ahead = (view.target - view.eye).normalized();
      const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
      const Eigen::Vector3d up = right.cross(ahead);
      for (const Eigen::Vector3d& corner : world_corners(figure, snapshots.at(time))) {
        const Eigen::Vector3d p = corner - view.eye;
        const double half = std::tan(0.5 * view.angle) * p.dot(ahead);
        EXPECT_LT(std::abs(p.dot(up)), half);
        EXPECT_LT(std::abs(p.dot(right)), half * shape);
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::render
