// Links that meet each other against closed forms, conservation laws and the same contact of a foot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "simulator/trace/error.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kStiffness = 2e6;  // N at a depth of a metre
constexpr double kGravity = 9.81;

std::string law(const std::string& name, const std::string& at,
                const std::vector<std::array<std::string, 3>>& values) {
  std::string text = "  - effect: " + name + "\n    at: " + at + "\n    values:\n";
  for (const auto& [parameter, value, unit] : values) {
    text += "      " + parameter + ": {value: " + value + ", unit: '" + unit + "', assumed: test}\n";
  }
  return text;
}

std::string normal(const std::string& at, const std::string& damping, const std::string& exponent = "1.5") {
  return law("ground_normal", at,
             {{"stiffness", "2e6", "N"}, {"damping", damping, "N s/m"}, {"exponent", exponent, "1"}});
}

std::string friction(const std::string& at) {
  return law(
      "ground_friction", at,
      {{"bristle_stiffness", "2e4", "1/m"}, {"bristle_damping", "20", "s/m"}, {"friction", "0.8", "1"}});
}

std::string world(const std::string& bodies, const std::string& gravity = "0 0 0") {
  return "<mujoco><option gravity='" + gravity + "'/><worldbody>" + bodies + "</worldbody></mujoco>";
}

class LinksInContact : public testing::Test {
 protected:
  Model model(const std::string& skeleton, const std::string& contacts, const std::string& effects,
              const std::string& feet = "") const {
    folder_.write("skeleton.xml", skeleton);
    return read_model(
        folder_.write("model.yaml", "plumbline: model/1\nrobot: two\nskeleton: skeleton.xml\n" + feet +
                                        "contacts:\n" + contacts + "effects:\n" + effects),
        known_effects());
  }

  static run::CommandedRun run(Plant& plant, const Eigen::VectorXd& x0, Eigen::Index samples,
                               double period = 1e-3) {
    run::CommandedOptions options;
    options.integrator.method = integrate::Method::rosenbrock;
    options.integrator.relative_tolerance = 1e-8;
    options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-11);
    options.energy = true;
    options.events = true;
    return run::run_commands(plant, x0, Eigen::MatrixXd::Zero(0, samples), period, 0.0, {}, nullptr, options);
  }

  test::TemporaryFolder folder_;
};

const char* const kOnALine =
    "<body name='a'><joint name='xa' type='slide' axis='1 0 0'/><geom name='a' size='0.1' mass='2'/></body>"
    "<body name='b' pos='0.5 0 0'><joint name='xb' type='slide' axis='1 0 0'/><geom name='b' size='0.05' "
    "mass='3'/></body>";
const char* const kBallOnBall = "  pair: {between: [{sphere: a}, {sphere: b}], assumed: test}\n";

// Without damping the relative velocity turns round, and the centre of mass moves on: closed forms of an
// elastic impact. The run's error is that of its tolerance; momentum is a sum that every step keeps.
TEST_F(LinksInContact, TwoBallsOnALineBounceWithoutLoss) {
  Plant plant(model(world(kOnALine), kBallOnBall, normal("pair", "0")), {});
  const Eigen::Vector4d x(0.0, 0.0, 1.5, -0.5);
  const run::CommandedRun result = run(plant, x, 400);
  const Eigen::VectorXd end = result.states.col(399);
  const double together = (2.0 * 1.5 - 3.0 * 0.5) / 5.0;
  EXPECT_NEAR(end[2], 2.0 * together - 1.5, 1e-6);
  EXPECT_NEAR(end[3], 2.0 * together + 0.5, 1e-6);
  for (Eigen::Index k = 0; k < 400; ++k) {
    EXPECT_NEAR(2.0 * result.states(2, k) + 3.0 * result.states(3, k), 1.5, 1e-12);
  }
  const double kinetic = 0.5 * (2.0 * 1.5 * 1.5 + 3.0 * 0.5 * 0.5);  // J; nothing is exchanged
  EXPECT_LT(std::abs(result.energy_error), 1e-6 * kinetic);
  ASSERT_EQ(result.events.size(), 2U);  // they meet where the gap of 0.35 m is closed, and part
  EXPECT_NEAR(result.events.front().time, 0.35 / 2.0, 1e-9);
}

// Hunt and Crossley (1975) integrated: a (v_in + v_out) = ln((1 + a v_in)/(1 - a v_out)), a =
// damping/stiffness, of the velocities relative to each other and whatever the masses.
TEST_F(LinksInContact, ADampedImpactLosesWhatHuntAndCrossleySay) {
  Plant plant(model(world(kOnALine), kBallOnBall, normal("pair", "4e5")), {});
  const run::CommandedRun result = run(plant, Eigen::Vector4d(0.2, 0.0, 1.5, -0.5), 200);
  const Eigen::VectorXd end = result.states.col(199);
  const double v_in = 2.0;
  const double v_out = end[3] - end[2];
  const double a = 4e5 / kStiffness;
  EXPECT_NEAR(a * (v_in + v_out), std::log((1.0 + a * v_in) / (1.0 - a * v_out)), 1e-6);
  EXPECT_LT(v_out, 0.9 * v_in);
  EXPECT_LT(std::abs(result.energy_error), 1e-7 * result.energy_exchanged);
}

const char* const kStack =
    "<body name='box'><joint name='h' type='slide' axis='0 0 1'/><joint name='r' type='slide' axis='1 0 0'/>"
    "<geom type='box' size='0.2 0.15 0.1' mass='4'/></body>"
    "<body name='ball'><freejoint/><geom name='ball' size='0.05' mass='1.5'/></body>";

/// A ball on a box on the world's floor.
const char* const kStacked =
    "  top: {between: [{link: box, value: [0, 0, 0], unit: m, box: [0.4, 0.3, 0.2]}, {sphere: ball}], "
    "assumed: test}\n"
    "  floor:\n    between:\n      - {link: box, value: [0, 0, 0], unit: m, box: [0.4, 0.3, 0.2]}\n"
    "      - {link: world, value: [0, 0, -100], unit: mm, plane: [0, 0, 3]}\n    assumed: test\n";

// A linear law: the ball sinks in by m g/k, the box, on four of its eight corners, by M g/(4 k).
TEST_F(LinksInContact, AStackRestsAsDeepAsItsWeights) {
  Plant plant(
      model(world(kStack, "0 0 -9.81"), kStacked, normal("top", "0", "1") + normal("floor", "0", "1")), {});
  ASSERT_EQ(plant.link_points(), 9);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const double ball = 1.5 * kGravity / kStiffness;
  const double box = 5.5 * kGravity / (4.0 * kStiffness);
  x[0] = -box;
  x[4] = 0.15 - box - ball;
  Eigen::VectorXd rate(plant.states());
  plant.rate(x.data(), nullptr, rate.data());
  EXPECT_LT(rate.cwiseAbs().maxCoeff(), 1e-6);  // against g; a depth is known to 1e-17 of 0.15 m
  const std::vector<Vector3d> forces = plant.contact_forces(x.data());
  EXPECT_NEAR(forces[0].z(), -1.5 * kGravity, 1e-5);  // of the ball on the box, which the file names first
  EXPECT_NEAR(forces[1].z(), 5.5 * kGravity, 1e-5);
  EXPECT_LT(forces[0].head<2>().norm() + forces[1].head<2>().norm(), 1e-12);
}

// A ball rolls down a tilted box as soon as friction holds: about the point of contact, which is half the
// depth below its surface, a = g sin(slope)/(1 + 2/5 (r/arm)^2) with the arm r - depth/2.
TEST_F(LinksInContact, ABallRollsDownATiltedBox) {
  const std::string tilted =
      "<body name='table'><geom type='box' size='1 3 0.1' mass='4'/></body>"
      "<body name='ball'><freejoint/><geom name='ball' size='0.1' mass='2'/></body>";
  const std::string contact =
      "  top:\n    between:\n      - {sphere: ball}\n      - {link: table, value: [0, 0, 0], unit: m, box: "
      "[2, 6, 0.2], "
      "turn: {value: [0.2, 0, 0], unit: rad}}\n    assumed: test\n";
  Plant plant(model(world(tilted, "0 0 -9.81"), contact, normal("top", "4e5") + friction("top")), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const double depth = std::pow(2.0 * kGravity * std::cos(0.2) / kStiffness, 1.0 / 1.5);
  const Vector3d up(0.0, -std::sin(0.2), std::cos(0.2));
  x.head<3>() = (0.2 - depth) * up;
  const run::CommandedRun result = run(plant, x, 1001);
  const Vector3d along(0.0, -std::cos(0.2), -std::sin(0.2));
  const auto speed = [&](Eigen::Index k) { return along.dot(result.states.col(k).segment<3>(6)); };
  const double arm = 0.1 - 0.5 * depth;
  const double a = kGravity * std::sin(0.2) / (1.0 + 0.4 * 0.1 * 0.1 / (arm * arm));
  EXPECT_NEAR((speed(1000) - speed(200)) / 0.8, a, 1e-4 * a);
  EXPECT_NEAR(speed(1000), arm * result.states(11, 1000), 2e-4 * speed(1000));  // no slip
  EXPECT_LT(std::abs(result.energy_error), 1e-5 * result.energy_exchanged);
}

/// A free ball beside the world's floor: as a foot, and as a contact.
constexpr const char* kBall = "<body name='ball'><freejoint/><geom name='skin' size='0.1' mass='2'/></body>";

// The same laws at the same place: a contact with a plane of the world is a foot on level ground.
TEST_F(LinksInContact, APlaneOfTheWorldIsTheGroundOfAFoot) {
  Plant foot(
      model(world(kBall, "0 0 -9.81"), "  {}\n", normal("toe", "4e5") + friction("toe"),
            "feet: {toe: {link: ball, value: [0.01, 0.02, -0.03], unit: m, radius: 0.08, assumed: test}}\n"),
      {});
  Plant pair(
      model(
          world(kBall, "0 0 -9.81"),
          "  floor:\n    between:\n      - {link: ball, value: [0.01, 0.02, -0.03], unit: m, radius: 0.08}\n"
          "      - {link: world, value: [0, 0, 0], unit: m, plane: [0, 0, 1]}\n    assumed: test\n",
          normal("floor", "4e5") + friction("floor")),
      {});
  ASSERT_EQ(foot.states(), pair.states());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> spread(-1.0, 1.0);
  Eigen::VectorXd one(foot.states()), other(foot.states());
  for (int trial = 0; trial < 50; ++trial) {
    Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(foot.states(), [&]() { return spread(random); });
    x.tail(2) *= 2e-5;
    x[2] += foot.foot_depth(0, x.data()).depth - 1e-4 * spread(random);
    foot.rate(x.data(), nullptr, one.data());
    pair.rate(x.data(), nullptr, other.data());
    // The foot asks its lowest point, the pair a point half the depth higher: of no weight but for the arm.
    const double depth = std::max(foot.foot_depth(0, x.data()).depth, 0.0);
    EXPECT_NEAR(pair.link_touches(x.data()).front().depth, foot.foot_depth(0, x.data()).depth, 1e-15);
    const double slack = depth / 0.08;
    EXPECT_LT((one - other).norm(), slack * one.norm() + 1e-12) << trial;
  }
}

/// Two free balls that graze each other while both spin.
const char* const kTwoFree =
    "<body name='a'><freejoint/><geom name='a' size='0.1' mass='2'/></body>"
    "<body name='b'><freejoint/><geom name='b' size='0.05' mass='0.7'/></body>";

Eigen::VectorXd grazing(const Plant& plant) {
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x.segment<3>(6) << 0.08, 0.05, 0.12;
  x.segment<3>(3) << 0.3, -0.4, 0.5;
  x.segment<3>(9) << -0.2, 0.1, 0.1;
  x.segment<3>(12) << 0.5, 0.2, 0.3;
  x.segment<3>(15) << 3.0, -2.0, 1.0;
  x.segment<3>(18) << -0.5, -0.1, -0.6;
  x.segment<3>(21) << 1.0, 1.0, -4.0;
  return x;
}

/// Linear and angular momentum about the world's origin of homogeneous balls, 2/5 m r^2.
Eigen::Matrix<double, 6, 1> momentum(Plant& plant, const Eigen::VectorXd& x) {
  Eigen::VectorXd rate(plant.states());
  plant.rate(x.data(), nullptr, rate.data());
  const TreeDynamics& tree = plant.tree();
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t b = 0; b < tree.bodies().size(); ++b) {
    const TreeBody& body = tree.bodies()[b];
    if (body.mass > 0.0) {
      const int index = static_cast<int>(b);
      const Vector3d at = tree.station(index, body.com);
      const Vector3d p = body.mass * tree.station_velocity(index, at);
      sum.head<3>() += p;
      sum.tail<3>() += at.cross(p) + body.inertia(0, 0) * tree.angular_velocity(index);
    }
  }
  return sum;
}

// Forces are equal and opposite at one point: with friction and damping both momenta stay, the linear one to
// rounding, the angular one to the run's tolerance (angles are no sums); the energy's account closes.
TEST_F(LinksInContact, AGrazingImpactKeepsBothMomenta) {
  Plant plant(model(world(kTwoFree), kBallOnBall, normal("pair", "4e5") + friction("pair")), {});
  const Eigen::VectorXd x = grazing(plant);
  const run::CommandedRun result = run(plant, x, 16);
  const auto before = momentum(plant, x);
  const auto after = momentum(plant, result.states.col(15));
  EXPECT_LT((after - before).head<3>().norm(), 1e-12);
  EXPECT_LT((after - before).tail<3>().norm(), 1e-7 * before.tail<3>().norm());
  EXPECT_GT((result.states.col(15) - x).segment<3>(12).norm(), 0.1);  // they have met
  EXPECT_GT((result.states.col(15) - x).segment<3>(15).norm(), 0.1);  // and turned each other
  EXPECT_LT(std::abs(result.energy_error), 1e-5 * result.energy_exchanged);
}

// What a contact is called where an integrator gives up, and its states.
TEST_F(LinksInContact, NamesItsStatesAndItsStiffness) {
  Plant plant(model(world(kTwoFree), kBallOnBall, normal("pair", "4e5") + friction("pair")), {});
  Eigen::VectorXd x = grazing(plant);
  x.segment<3>(6) *= 0.149 / x.segment<3>(6).norm();
  EXPECT_EQ(plant.state_names().back(), "bristle_y of ground_friction at pair");
  EXPECT_THAT(plant.stiffest(x.data(), nullptr).element, HasSubstr("at pair"));
  EXPECT_EQ(plant.link_points(), 1);
}

}  // namespace
}  // namespace plumbline::model
