// Balanced postures against plane trigonometry.
#include "validation/studies/recipes/posture.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::validation {
namespace {

model::Model stance() {
  return model::read_model(std::string(PLUMBLINE_ROOT) + "/robots/mabel/stance.yaml", model::known_effects());
}

Postures postures() {
  Postures some;
  some.locked = {"mLA_left", "mLS_left", "mLA_right", "mLS_right", "bsp_right"};
  some.balanced = "torso";
  some.hand = 2e-3;
  some.poses = {{{{"leg_shape_left", 0.2},
                  {"leg_angle_left", 0.1},
                  {"leg_shape_right", 0.6},
                  {"leg_angle_right", -0.2},
                  {"bsp_left", 0.0},
                  {"bsp_right", 0.0}}}};
  return some;
}

struct Point {
  double x, z;
};

/// (0, -1) turned counter-clockwise by an angle (seen from the right side, x to the right): down a link at
/// zero.
Point down(double angle) { return {std::sin(angle), -std::cos(angle)}; }

class BalancedStance : public testing::Test {
 protected:
  double reading(const char* sensor) const { return readings_[model_.sensor_index(sensor)]; }

  model::Model model_ = stance();
  Postures postures_ = postures();
  Posture posture_{model_, postures_, postures_.poses[0],
                   held_by_pose(model_, postures_, postures_.poses[0])};
  Eigen::VectorXd readings_ = posture_.readings();
};

// Park et al. section Torso: a robot that is balanced has its centre of mass over the toe. Positions by
// trigonometry from what the sensors read, with the masses and lengths of Table VI (r_y along the link; r_x
// too, in sources.md's sense).
TEST_F(BalancedStance, HasItsCentreOfMassOverTheToe) {
  const double torso = reading("torso");
  double moment = 0.0;
  double mass = 0.0;
  const auto add = [&](double m, Point origin, double angle, double rx, double ry) {
    // Along the link: down by ry; across it: (-rx) along the link's own x.
    const Point along = down(angle);
    moment += m * (origin.x + ry * along.x - rx * std::cos(angle));
    mass += m;
  };
  const double thigh = torso + reading("thigh_left");
  const double shin = thigh + reading("knee_left");
  const Point hip{-0.5 * down(thigh).x - 0.5 * down(shin).x, 0.0};
  const auto leg = [&](double thigh_angle, double shin_angle, double leg_shape, double q_shin) {
    const Point knee{hip.x + 0.5 * down(thigh_angle).x, 0.0};
    add(3.2818, hip, thigh_angle, 0.000311, 0.1978);
    add(1.5007, knee, shin_angle, 0.0009671, 0.157);
    const Point spring_pivot{hip.x - 0.2 * down(torso).x, 0.0};
    add(1.8987, spring_pivot, torso + 2.0 * leg_shape, 0.0009406, 0.1181);
    add(1.6987, hip, torso + q_shin, 0.0004345, 0.08684);
  };
  leg(thigh, shin, -0.5 * reading("knee_left"), reading("thigh_left") + reading("knee_left"));
  const double thigh_right = torso + reading("thigh_right");
  leg(thigh_right, thigh_right + reading("knee_right"), -0.5 * reading("knee_right"),
      reading("thigh_right") + reading("knee_right"));
  moment += 40.8953 * (hip.x + 0.01229 * std::cos(torso) - 0.18337 * std::sin(torso));
  moment += 4.789761 * hip.x;
  mass += 40.8953 + 4.789761;
  EXPECT_NEAR(moment / mass, 0.0, 1e-7);  // m; the equilibrium is exact to about 1e-9 of the weight
  EXPECT_NEAR(total_weight(model_), mass * 9.80665, 1e-3);
}

// By virtual work with the motor held, B_Spring carries the torque of the leg shape over 5.18, and so do the
// cables over 31.42: K_B q + preload = 5.18/... of each other, whatever the load.
TEST_F(BalancedStance, SpringAndCablesCarryTheSameLoad) {
  const double leg_shape = -0.5 * reading("knee_left");
  const double stretch = reading("mLS_left") - 31.42 * leg_shape + 31.42 / 5.18 * reading("bsp_left");
  const double at_spring = 100.0 * reading("bsp_left") + 1.0;  // the file's start values
  EXPECT_GT(at_spring, 5.0);
  EXPECT_NEAR(at_spring, -5.0 * stretch * 31.42 / 5.18, 1e-5 * at_spring);
}

TEST_F(BalancedStance, AHandMovesTheBalancedCoordinateAndLittleElse) {
  const Eigen::VectorXd moved = posture_.readings(1e-3);
  const int torso = model_.sensor_index("torso");
  EXPECT_NEAR(moved[torso] - readings_[torso], 1e-3, 1e-9);
  const int knee = model_.sensor_index("knee_left");
  EXPECT_LT(std::abs(moved[knee] - readings_[knee]), 2e-4);
}

}  // namespace
}  // namespace plumbline::validation
