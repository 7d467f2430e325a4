// The machine's model files: the parallelogram closes, and the boom's leverage is what the force-plate
// records show.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/body_poses.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline {
namespace {

model::Model read(const std::string& name) {
  return model::read_model(PLUMBLINE_ROOT "/robots/atrias/" + name, model::known_effects());
}

/// Positions of all joints that move, in the skeleton's order, with the ties of the parallelogram kept.
Eigen::VectorXd positions(double thigh, double shin) {
  Eigen::VectorXd q(11);
  q << 0.0, 0.9, 0.0, thigh, shin, shin - thigh, thigh - shin, 0.0, 0.0, 0.0, 0.0;
  return q;
}

TEST(AtriasModel, TheParallelogramCloses) {
  const model::Model robot = read("atrias.yaml");
  const auto poses = model::body_poses(robot.skeleton, positions(0.5, -0.4));
  const auto at = [&](const char* link, double down) {
    return Eigen::Vector3d(poses[static_cast<std::size_t>(robot.body_index(link))] *
                           Eigen::Vector3d(0, 0, -down));
  };
  EXPECT_LT((at("coupler_left", 0.5) - at("lower_left", 0.4)).norm(), 1e-12);
  // Leg length 2 x 0.5 m x cos(rho/2) (Wu 2017, section 4.3.4).
  EXPECT_NEAR((at("thigh_left", 0.0) - at("lower_left", 0.5)).norm(), std::cos(0.45), 1e-12);
}

TEST(AtriasModel, OuterAndInnerLegCarryWhatTheForcePlateShows) {
  // The hip rises by dz where the foot rises by (1 - curvature*y) dz, so a leg carries the weight with one
  // over that. Records of 9 and 12 April 2015: left leg 546.8 N, right leg 660.6 N, means over 30 and 12
  // whole hops.
  const model::Model robot = read("atrias_measured_springs.yaml");
  double curvature = 0.0;
  for (const model::EffectUse& use : robot.effects) {
    curvature = use.law->declaration().name == "boom" ? use.numbers()[0] : curvature;
  }
  const auto poses = model::body_poses(robot.skeleton, positions(0.4, -0.4));
  const auto share = [&](const char* link) {
    return 1.0 /
           (1.0 - curvature * poses[static_cast<std::size_t>(robot.body_index(link))].translation().y());
  };
  EXPECT_NEAR(share("lower_left") / share("lower_right"), 546.8 / 660.6, 0.01);
}

}  // namespace
}  // namespace plumbline
