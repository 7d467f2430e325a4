// Fixed points of maps, and drawn robots.
#include "validation/control/gait/fixed_point.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/control/gait/drawn_models.h"

namespace plumbline::validation {
namespace {

// u1' = 1 + 1.5 (u1 - 1) + (u1 - 1)^2, u2' = 2 + 0.2 (u2 - 2) - 0.5 (u1 - 1): fixed point (1, 2), slope
// [[1.5, 0], [-0.5, 0.2]], multipliers 1.5 and 0.2, with jumps of 1e-4 as counts leave them.
std::optional<Eigen::VectorXd> rough_map(const Eigen::VectorXd& u) {
  if (u.norm() > 10.0) {
    return std::nullopt;
  }
  const double a = u[0] - 1.0;
  const double b = u[1] - 2.0;
  Eigen::VectorXd image(2);
  image << 1.0 + 1.5 * a + a * a, 2.0 + 0.2 * b - 0.5 * a;
  return 1e-4 * (1e4 * image).array().round().matrix();
}

TEST(FixedPoint, IsFoundThoughUnstableAndRough) {
  const FixedPoint point =
      find_fixed_point(rough_map, Eigen::Vector2d(1.1, 1.7), Eigen::Vector2d::Constant(1e-2), 0.02, 10, {});
  EXPECT_TRUE(point.found);
  EXPECT_NEAR(point.at[0], 1.0, 1e-3);
  EXPECT_NEAR(point.at[1], 2.0, 1e-3);
  EXPECT_NEAR(point.growth, 1.5, 0.02);
}

TEST(FixedPoint, WhereTheMapEndsNothingIsFound) {
  const FixedPoint point =
      find_fixed_point(rough_map, Eigen::Vector2d(40.0, 0.0), Eigen::Vector2d::Constant(1e-2), 0.02, 10, {});
  EXPECT_FALSE(point.found);
}

TEST(DrawnModels, StayWithinTheirShareAndDiffer) {
  const model::Model mabel =
      model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", model::known_effects());
  const std::vector<model::Model> drawn = draw_models(mabel, 3, 0.05, 1);
  ASSERT_EQ(drawn.size(), 3U);
  EXPECT_NE(drawn[0].skeleton.bodies[3].mass, drawn[1].skeleton.bodies[3].mass);
  for (const model::Model& one : drawn) {
    ASSERT_EQ(one.effects.size(), mabel.effects.size() + 4);
    for (std::size_t b = 0; b < one.skeleton.bodies.size(); ++b) {
      EXPECT_NEAR(one.skeleton.bodies[b].mass, mabel.skeleton.bodies[b].mass,
                  0.05001 * mabel.skeleton.bodies[b].mass);
    }
    int cables = 0;
    for (std::size_t e = 0; e < mabel.effects.size(); ++e) {
      if (one.effects[e].law->declaration().name == "cable_stretch") {
        const double factor = one.effects[e].values[0].value / mabel.effects[e].values[0].value;
        EXPECT_NE(factor, 1.0);
        EXPECT_NEAR(factor, 1.0, 0.05);
        ++cables;
      }
    }
    EXPECT_EQ(cables, 4);
    EXPECT_NEAR(one.effects.back().values[0].value, 1.0, 0.05);
    EXPECT_EQ(one.effects.back().law->declaration().name, "torque_constant_error");
  }
}

}  // namespace
}  // namespace plumbline::validation
