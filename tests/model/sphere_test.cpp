// Spherical feet and boxes on the ground against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/rigid_contact.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "simulator/trace/error.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::HasSubstr;

constexpr double kRadius = 0.1;  // m
constexpr double kGravity = 9.81;
constexpr double kSlope = 0.2;  // rad

/// A homogeneous ball (2/5 m r^2) of 2 kg, or a cube of that side; gravity leans over by `slope` along y.
std::string mjcf(const std::string& geom, double slope) {
  return "<mujoco><option gravity='0 " + std::to_string(-kGravity * std::sin(slope)) + " " +
         std::to_string(-kGravity * std::cos(slope)) + "'/><worldbody><body name='ball'><freejoint/>" + geom +
         "</body></worldbody></mujoco>";
}
const char* const kBall = "<geom name='skin' size='0.1' mass='2'/>";
const char* const kCube = "<geom type='box' size='0.1 0.1 0.1' mass='2'/>";

std::string ground(const std::string& at, double damping, bool friction) {
  std::string text = "effects:\n  - effect: ground_normal\n    at: " + at +
                     "\n    values:\n      stiffness: {value: 2e6, unit: N, assumed: test}\n"
                     "      damping: {value: " +
                     std::to_string(damping) + ", unit: N s/m, assumed: test}\n";
  if (friction) {
    text += "  - effect: ground_friction\n    at: " + at +
            "\n    values:\n"
            "      bristle_stiffness: {value: 2e4, unit: 1/m, assumed: test}\n"
            "      bristle_damping: {value: 20, unit: s/m, assumed: test}\n"
            "      friction: {value: 0.8, unit: '1', assumed: test}\n";
  }
  return text;
}

class Spheres : public testing::Test {
 protected:
  Model model(const std::string& skeleton, const std::string& feet, const std::string& effects) const {
    folder_.write("ball.xml", skeleton);
    return read_model(
        folder_.write("model.yaml",
                      "plumbline: model/1\nrobot: ball\nskeleton: ball.xml\nfeet: " + feet + "\n" + effects),
        known_effects());
  }

  static run::CommandedRun run(Plant& plant, const Eigen::VectorXd& x0, Eigen::Index samples) {
    run::CommandedOptions options;
    options.integrator.method = integrate::Method::rosenbrock;
    options.integrator.relative_tolerance = 1e-7;
    options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-10);
    return run::run_commands(plant, x0, Eigen::MatrixXd::Zero(0, samples), 1e-3, 0.0, {}, nullptr, options);
  }

  test::TemporaryFolder folder_;
};

// Without slip a homogeneous ball gathers speed by a = g sin(slope)/(1 + 2/5), from the moment friction
// holds.
TEST_F(Spheres, ABallRollsDownASlope) {
  Plant plant(model(mjcf(kBall, kSlope), "take", ground("feet", 4e5, true)), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[2] = kRadius - std::pow(2.0 * kGravity * std::cos(kSlope) / 2e6, 1.0 / 1.5);
  const run::CommandedRun result = run(plant, x, 1001);
  const double a = kGravity * std::sin(kSlope) / (1.0 + 0.4);
  const auto speed = [&](Eigen::Index k) { return -result.states(7, k); };
  EXPECT_NEAR((speed(1000) - speed(200)) / 0.8, a, 1e-4 * a);
  const double turn = result.states(11, 1000);  // roll rate; no slip: v = r w
  EXPECT_NEAR(speed(1000), kRadius * turn, 2e-3 * speed(1000));
  EXPECT_GT(result.states(5, 1000), 2.0 * M_PI * 0.9);  // it has turned once, and nothing is singular there
  EXPECT_LT(std::abs(result.energy_error), 1e-5 * result.energy_exchanged);
}

std::string turning(const std::string& at) {
  return "  - effect: rolling_friction\n    at: " + at +
         "\n    values: {arm: {value: 2e-3, unit: m, assumed: test}}\n  - effect: spinning_friction\n    "
         "at: " +
         at +
         "\n    values: {radius: {value: 5e-3, unit: m, assumed: test}, spin_speed: {value: 0.5, unit: "
         "rad/s, assumed: "
         "test}}\n";
}

// A homogeneous ball that rolls without slip loses speed by g arm / (r (1 + 2/5)); about its normal it is a
// top whose turn is slowed by m g radius over 2/5 m r^2.
TEST_F(Spheres, ABallRollsAndSpinsOut) {
  Plant plant(model(mjcf(kBall, 0.0), "take", ground("feet", 4e5, true) + turning("feet")), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[2] = kRadius - std::pow(2.0 * kGravity / 2e6, 1.0 / 1.5);
  x[7] = -0.5;
  x[11] = 5.0;
  const run::CommandedRun rolls = run(plant, x, 1001);
  const double a = kGravity * 2e-3 / (1.4 * kRadius);
  EXPECT_NEAR((rolls.states(7, 1000) - rolls.states(7, 200)) / 0.8, a, 2e-3 * a);
  EXPECT_LT(std::abs(rolls.energy_error), 1e-5 * rolls.energy_exchanged);
  x[7] = x[11] = 0.0;
  x[9] = 8.0;
  const run::CommandedRun spins = run(plant, x, 501);
  const double slowing = kGravity * 5e-3 / (0.4 * kRadius * kRadius);
  EXPECT_NEAR((spins.states(9, 0) - spins.states(9, 500)) / 0.5, slowing, 1e-3 * slowing);
}

// It touches down when its centre is a radius above the ground, and rebounds as Hunt and Crossley integrated
// (1975): a (v_in + v_out) = ln((1 + a v_in)/(1 - a v_out)), a = damping/stiffness, with hardly any weight.
TEST_F(Spheres, ADroppedBallRebounds) {
  const std::string weightless =
      "<mujoco><option gravity='0 0 -1e-9'/><worldbody><body name='ball'><freejoint/>" + std::string(kBall) +
      "</body></worldbody></mujoco>";
  Plant plant(model(weightless, "{toe: {sphere: skin}}", ground("toe", 4e5, false)), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[2] = kRadius + 0.0012;
  x[8] = -1.2;
  x[10] = 3.0;  // spinning changes nothing without friction
  const run::CommandedRun result = run(plant, x, 60);
  ASSERT_EQ(result.events.size(), 2U);
  EXPECT_NEAR(result.events.front().time, 1e-3, 1e-9);
  const double v_out = result.states(8, 59);
  const double a = 0.2;
  EXPECT_NEAR(a * (1.2 + v_out), std::log((1.0 + a * 1.2) / (1.0 - a * v_out)), 1e-7);
}

// Eight corners share one law: a cube that stands on four of them weighs on each by a quarter.
TEST_F(Spheres, ACubeStandsOnItsCorners) {
  Plant plant(model(mjcf(kCube, 0.0),
                    "{cube: {link: ball, value: [0, 0, 0], unit: m, box: [0.2, 0.2, 0.2], assumed: test}}",
                    ground("cube", 4e6, true)),
              {});
  ASSERT_EQ(plant.model().feet.size(), 8U);
  EXPECT_EQ(plant.model().places(effects::Place::foot), std::vector<std::string>{"cube"});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[2] = kRadius + 0.02;
  x[3] = 0.3;
  const run::CommandedRun result = run(plant, x, 1500);
  const Eigen::VectorXd end = result.states.col(1499);
  double carried = 0.0;
  for (const Touch& touch : plant.touches(end.data())) {
    carried += touch.force.z();
    EXPECT_TRUE(touch.force.z() == 0.0 || std::abs(touch.force.z() - 0.25 * 2.0 * kGravity) < 1e-2);
  }
  EXPECT_NEAR(carried, 2.0 * kGravity, 1e-2);
}

/// Rates by differences beside the linearisation, of a foot a millimetre deep that rolls, slips and spins.
void expect_slopes_of_the_rates(Plant& plant, Eigen::VectorXd x) {
  const Eigen::Index n = plant.positions();
  x[2] += plant.foot_depth(0, x.data()).depth - 1e-3;
  ASSERT_NEAR(plant.foot_depth(0, x.data()).depth, 1e-3, 1e-12);
  const auto rate = [&](const Eigen::VectorXd& at) {
    Eigen::VectorXd xdot = Eigen::VectorXd::Zero(at.size());
    plant.rate(at.data(), nullptr, xdot.data());
    return xdot;
  };
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(x.size());
  Eigen::MatrixXd A, B;
  plant.tangent({x.data(), still.data(), nullptr, nullptr, 1e-3}, {}, Eigen::VectorXd(0), true, A, B);
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double step = i < n ? 1e-8 : 1e-7;
    Eigen::VectorXd moved = x;
    moved[i] = x[i] + step;
    const Eigen::VectorXd up = rate(moved);
    moved[i] = x[i] - step;
    const Eigen::VectorXd expected = (up - rate(moved)) / (2.0 * step);
    EXPECT_LT((A.col(i) - expected).norm(), 1e-5 * expected.norm() + 0.02)
        << plant.state_names()[static_cast<std::size_t>(i)] << ": " << expected.norm();
  }
}

const char* const kToe =
    "{toe: {link: ball, value: [0.01, 0.02, -0.03], unit: m, radius: 0.08, assumed: test}}";

TEST_F(Spheres, SlopesAreThoseOfTheRates) {
  Plant plant(model(mjcf(kBall, kSlope), kToe, ground("toe", 4e5, true)), {});
  Eigen::VectorXd x(plant.states());
  x << 0.1, 0.2, 0.0, 0.4, 0.3, -0.5, 0.3, -0.2, 0.1, 1.2, -0.7, 0.9, 1e-5, -2e-5;
  expect_slopes_of_the_rates(plant, x);
}

// Slipping fast, and within the speed at which the friction fades.
TEST_F(Spheres, SlopesOfCoulombFrictionAreThoseOfTheRates) {
  const std::string coulomb =
      "  - effect: ground_coulomb\n    at: toe\n    values:\n"
      "      friction: {value: 0.8, unit: '1', assumed: test}\n"
      "      slip_speed: {value: 0.05, unit: m/s, assumed: test}\n";
  Plant plant(model(mjcf(kBall, kSlope), kToe, ground("toe", 4e5, false) + coulomb), {});
  Eigen::VectorXd x(plant.states());
  x << 0.1, 0.2, 0.0, 0.4, 0.3, -0.5, 0.3, -0.2, 0.1, 1.2, -0.7, 0.9;
  expect_slopes_of_the_rates(plant, x);
  x.tail(6) << 0.02, -0.03, 0.01, 0.1, -0.05, 0.2;
  expect_slopes_of_the_rates(plant, x);
}

// Rolling fast, and within the speeds at which both fade; by the two values, too.
TEST_F(Spheres, SlopesOfTurningFrictionAreThoseOfTheRates) {
  Plant plant(model(mjcf(kBall, kSlope), kToe, ground("toe", 4e5, true) + turning("toe")), {});
  Eigen::VectorXd x(plant.states());
  x << 0.1, 0.2, 0.0, 0.4, 0.3, -0.5, 0.3, -0.2, 0.1, 1.2, -0.7, 0.9, 1e-5, -2e-5;
  expect_slopes_of_the_rates(plant, x);
  x.segment(6, 6) << 0.02, -0.03, 0.01, 0.1, -0.05, 0.2;
  expect_slopes_of_the_rates(plant, x);
  x[2] += plant.foot_depth(0, x.data()).depth - 1e-3;
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(x.size());
  Eigen::MatrixXd A, B;
  plant.tangent({x.data(), still.data(), nullptr, nullptr, 1e-3}, {{2, 0}, {3, 0}},
                Eigen::VectorXd::Constant(2, 1e-6), true, A, B);
  for (const int effect : {2, 3}) {
    Eigen::VectorXd before(x.size()), after(x.size());
    plant.rate(x.data(), nullptr, before.data());
    plant.set_value({effect, 0}, plant.value({effect, 0}) + 1e-3);
    plant.rate(x.data(), nullptr, after.data());
    plant.set_value({effect, 0}, plant.value({effect, 0}) - 1e-3);
    const Eigen::VectorXd expected = (after - before) / 1e-3;
    EXPECT_GT(expected.norm(), 1.0);
    EXPECT_LT((B.col(effect - 2) - expected).norm(), 1e-6 * expected.norm());
  }
}

TEST_F(Spheres, BadFeetAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& feet) {
    return test::refusal([&] { model(mjcf(kBall, 0.0), feet, ""); });
  };
  EXPECT_THAT(refusal("all"), HasSubstr("model.yaml:4: feet: found \"all\", expected take, or feet by name"));
  EXPECT_THAT(refusal("{toe: {sphere: skim}}"), HasSubstr("did you mean skin?"));
  const std::string point = "link: ball, value: [0, 0, 0], unit: m, assumed: test";
  EXPECT_THAT(refusal("{toe: {" + point + ", radius: -1}}"),
              HasSubstr("radius: found \"-1\", expected a number above zero"));
  EXPECT_THAT(refusal("{toe: {" + point + ", box: [1, 1, 0]}}"), HasSubstr("three edges above zero"));
  EXPECT_THAT(refusal("{toe: {" + point + ", group: heel}, heel: {" + point + "}}"),
              HasSubstr("two feet, or a foot and a group, called \"heel\""));
  const Model round = model(mjcf(kBall, 0.0), "take", "");
  Plant plant(round, {});
  EXPECT_THAT(test::refusal([&] { RigidContact contact(plant); }),
              HasSubstr("foot skin: found a radius of 0.1 m"));
}

}  // namespace
}  // namespace plumbline::model
