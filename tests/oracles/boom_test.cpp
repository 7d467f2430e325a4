// The effect `boom` on the robot in the plane against the robot whose skeleton has tower and boom as hinges:
// the same machine in other coordinates, hip_x = length*tower and hip_z = level + length*boom_pitch.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"

namespace plumbline::oracles {
namespace {

constexpr double kLength = 2.25, kLevel = 1.0;

model::Model robot(const std::string& file) {
  return model::read_model(PLUMBLINE_ROOT "/robots/mabel/" + file, model::known_effects());
}

/// Both with the same boom: a small ball where the robot hangs.
model::Body& boom_of(model::Model& model, double at) {
  model::Body& boom = model.skeleton.bodies[static_cast<std::size_t>(model.body_index("boom"))];
  boom.mass = 4.0;
  boom.com = {0.0, at, 0.0};
  boom.inertia = 1e-3 * Eigen::Matrix3d::Identity();
  return boom;
}

model::Model hinged() {
  model::Model model = robot("mabel.yaml");
  boom_of(model, -kLength);
  return model;
}

model::Model bent() {
  model::Model model = robot("mabel_planar_boom.yaml");
  boom_of(model, 0.0);
  model::EffectUse& use = *std::find_if(model.effects.begin(), model.effects.end(), [](const auto& one) {
    return one.at == "hip_z" && one.law->declaration().name == "preload";
  });
  use.values.front().value = 0.0;  // what the boom's weight is more than its inertia says
  return model;
}

class BoomTest : public testing::Test {
 protected:
  /// Random, with feet in the air and in the ground.
  void draw() {
    std::uniform_real_distribution<double> spread(-0.3, 0.3);
    std::uniform_real_distribution<double> pitch(-0.05, 0.02);
    const Eigen::Index n = hinged_.positions();
    at_hinges = Eigen::VectorXd::NullaryExpr(hinged_.states(), [&]() { return spread(random_); });
    at_hinges[1] = pitch(random_);
    along_arcs = at_hinges;
    along_arcs[0] *= kLength;
    along_arcs[1] = kLevel + kLength * at_hinges[1];
    along_arcs[n] *= kLength;
    along_arcs[n + 1] *= kLength;
    commands = Eigen::VectorXd::NullaryExpr(hinged_.motors(), [&]() { return 20.0 * spread(random_); });
  }

  std::mt19937_64 random_{5};
  model::Plant hinged_{hinged(), {}};
  model::Plant bent_{bent(), {}};
  Eigen::VectorXd at_hinges, along_arcs, commands;
};

TEST_F(BoomTest, MovesAsTheRobotAtItsHinges) {
  const Eigen::Index n = hinged_.positions();
  double worst = 0.0;
  int touching = 0;
  for (int state = 0; state < 300; ++state) {
    draw();
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(hinged_.states());
    Eigen::VectorXd found = expected;
    hinged_.rate(at_hinges.data(), commands.data(), expected.data());
    bent_.rate(along_arcs.data(), commands.data(), found.data());
    expected.segment(n, 2) *= kLength;
    worst = std::max(
        worst, (found - expected).tail(found.size() - n).norm() / expected.tail(found.size() - n).norm());
    touching += hinged_.touches(at_hinges.data()).front().depth > 0.0 ? 1 : 0;
  }
  EXPECT_LT(worst, 1e-9);
  EXPECT_GT(touching, 50);
  EXPECT_LT(touching, 250);
}

TEST_F(BoomTest, HoldsTheSameEnergy) {
  for (int state = 0; state < 20; ++state) {
    draw();
    const double expected = hinged_.energetics(at_hinges.data(), commands.data()).stored;
    const double found = bent_.energetics(along_arcs.data(), commands.data()).stored;
    EXPECT_NEAR(found, expected, 1e-9 * std::abs(expected));
  }
}

TEST_F(BoomTest, IsNothingWithoutCurvature) {
  model::Model straight = bent();
  model::EffectUse& use = straight.effects.back();
  ASSERT_EQ(use.law->declaration().name, "boom");
  use.values.front().value = 0.0;
  model::Model without = straight;
  without.effects.pop_back();
  model::Plant with_null(straight, {});
  model::Plant plain(without, {});
  draw();
  Eigen::VectorXd found = Eigen::VectorXd::Zero(plain.states());
  Eigen::VectorXd expected = found;
  with_null.rate(along_arcs.data(), commands.data(), found.data());
  plain.rate(along_arcs.data(), commands.data(), expected.data());
  EXPECT_EQ(found, expected);
}

TEST(Boom, NeedsAPlanarBase) {
  EXPECT_EQ(robot("mabel_planar.yaml").places(effects::Place::base), std::vector<std::string>{"base"});
  EXPECT_TRUE(robot("mabel.yaml").places(effects::Place::base).empty());
  EXPECT_TRUE(robot("leg_bench.yaml").places(effects::Place::base).empty());
}

}  // namespace
}  // namespace plumbline::oracles
