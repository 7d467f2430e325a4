// Traces read back as motions.
#include "simulator/render/motion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/trace/refusal.h"

namespace plumbline::render {
namespace {

using testing::HasSubstr;

// Stretches of some rad are pulled towards zero with a weight of 1e-6 of the sharpest encoder's, which is a
// hundred times a motor's: squared, 1e-8 and some.
constexpr double kPull = 1e-5;

class MotionTest : public testing::Test {
 protected:
  MotionTest()
      : plant_(model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", model::known_effects()),
               {}) {
    x_ = Eigen::MatrixXd::Zero(plant_.states(), 3);
    for (Eigen::Index i = 0; i < plant_.positions(); ++i) {
      x_.row(i) << 0.01 * static_cast<double>(i), 0.02 * static_cast<double>(i) - 0.1, 0.3;
    }
  }
  /// What `plumbline hop` would write of x_.
  Table trace() {
    Table table;
    table.file = "trace.csv";
    table.columns.push_back({"t", "s", Eigen::Vector3d(0.0, 0.001, 0.002)});
    Eigen::MatrixXd y(plant_.sensors(), 3);
    for (int k = 0; k < 3; ++k) {
      plant_.outputs(x_.col(k).data(), y.col(k).data());
    }
    for (int s = 0; s < plant_.sensors(); ++s) {
      table.columns.push_back(
          {"q_" + plant_.model().sensors[static_cast<std::size_t>(s)].name, "rad", y.row(s).transpose()});
    }
    for (const char* name : {"F_left_x", "F_left_y", "F_left_z", "F_right_x", "F_right_y", "F_right_z"}) {
      table.columns.push_back({name, "N", Eigen::Vector3d(1.0, 2.0, name[2] == 'l' ? 3.0 : 4.0)});
    }
    table.columns.push_back({"phase", "1", Eigen::Vector3d(1, 1, 2)});
    table.columns.push_back({"q_of_something_else", "rad", Eigen::Vector3d::Zero()});
    return table;
  }
  static void drop(Table& table, const std::string& name) {
    table.columns.erase(std::remove_if(table.columns.begin(), table.columns.end(),
                                       [&](const Column& column) { return column.name == name; }),
                        table.columns.end());
  }

  model::Plant plant_;
  Eigen::MatrixXd x_;
};

TEST_F(MotionTest, WithoutAPhaseTheFeetThatAreLoadedGiveOne) {
  Table table = trace();
  drop(table, "phase");
  Motion motion = motion_from(table, plant_);
  EXPECT_TRUE(motion.phase.empty());
  motion.foot_forces[0].col(0).setZero();
  motion.foot_forces[1].col(0).setZero();
  motion.foot_forces[1].col(2).setZero();
  const std::vector<std::string> names = phases_by_contact(plant_.model(), motion);
  EXPECT_THAT(motion.phase, testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(names, testing::ElementsAre("flight", "stance on left + right", "stance on left"));
  motion.foot_forces.clear();
  EXPECT_TRUE(phases_by_contact(plant_.model(), motion).empty());
  EXPECT_TRUE(motion.phase.empty());
}

TEST_F(MotionTest, PositionsForcesAndPhasesComeBack) {
  const Motion motion = motion_from(trace(), plant_);
  EXPECT_LT((motion.positions - x_.topRows(plant_.positions())).norm(), kPull);
  ASSERT_EQ(motion.foot_forces.size(), 2U);
  EXPECT_EQ(motion.foot_forces[0](2, 2), 3.0);
  EXPECT_EQ(motion.foot_forces[1](2, 2), 4.0);
  EXPECT_THAT(motion.phase, testing::ElementsAre(1, 1, 2));
}

TEST_F(MotionTest, CoordinatesByNameCountToo) {
  Table table = trace();
  drop(table, "q_torso");
  Eigen::VectorXd torso(3);
  for (int k = 0; k < 3; ++k) {
    torso[k] = plant_.position_of("torso", x_.col(k).data());
  }
  table.columns.push_back({"x_torso", "rad", torso});
  EXPECT_LT((motion_from(table, plant_).positions - x_.topRows(plant_.positions())).norm(), kPull);
}

TEST_F(MotionTest, RefusesWhatLeavesAPositionOpenOrGoesBackInTime) {
  Table open = trace();
  drop(open, "q_torso");
  EXPECT_THAT(test::refusal([&] { motion_from(open, plant_); }),
              HasSubstr("trace.csv: q_SENSOR, x_NAME: found 12 columns that leave a position open, expected "
                        "columns that determine all 13 positions"));
  Table back = trace();
  back.columns[0].values[2] = 0.001;
  EXPECT_THAT(test::refusal([&] { motion_from(back, plant_); }), HasSubstr("trace.csv:4: t: found"));
  Table none = trace();
  drop(none, "t");
  EXPECT_THAT(test::refusal([&] { motion_from(none, plant_); }), HasSubstr("t"));
}

TEST_F(MotionTest, WithoutForcesThereAreNone) {
  Table table = trace();
  drop(table, "F_left_y");
  EXPECT_THAT(motion_from(table, plant_).foot_forces, testing::IsEmpty());
}

}  // namespace
}  // namespace plumbline::render
