#include "validation/identify/inverse_model/inverse_model.h"

#include "tests/identify/closed_loop/slider.h"
#include "tests/identify/inverse_model/motion.h"
#include "tests/identify/trial/fixture.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class InverseModelTest : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    carriage = slider::read(folder);
  }
  double error(const Eigen::VectorXd& applied) const {
    const InverseModel inverse =
        inverse_model(carriage, motion.trial("q", motion.q, applied / slider::kGain), {});
    EXPECT_EQ(inverse.not_available, "");
    return inverse.motors.at(0).error_percent();
  }
  void add(const std::string& effect) {
    carriage.effects.push_back(parse_effect(effect, carriage, effects::Catalogue::all()));
  }
  model::Model carriage;
  const KnownMotion motion{0.1, 0.5, 0.01, 3.0};
  const Eigen::VectorXd force = slider::kMass * motion.a + slider::kDamping * motion.v;
};

// %: differences over 1 ms of 3 Hz are (w T)^2/6 = 0.006 % too small; the rest is the filters' ends.
constexpr double kDifferences = 0.03;

TEST_F(InverseModelTest, NewtonsSecondLaw) { EXPECT_LT(error(force), kDifferences); }

TEST_F(InverseModelTest, ForceThatTheModelLacks) {
  const Eigen::VectorXd friction = 2.0 * motion.v.array().sign();
  const double expected = 100.0 * friction.norm() / (force + friction).norm();
  EXPECT_NEAR(error(force + friction), expected, 0.02 * expected);  // the filter rounds the reversals' jumps
  add("coulomb@carriage:level=2,smoothing_speed=1e-4");
  EXPECT_LT(error(force + friction), 0.05 * expected);
}

TEST_F(InverseModelTest, BiasAndTorqueConstantOfTheDrive) {
  add("torque_bias@drive:bias=0.7");
  EXPECT_LT(error(force.array() - 0.7), kDifferences);
  add("torque_constant_error@drive:scale=1.25");
  EXPECT_LT(error(force.array() / 1.25 - 0.7), kDifferences);  // in the order of the list
}

// J dw/dt + m g l sin(q) at the shoulder of a hanging rod, by hand from the pendulum's files: J = 0.036 + 1.2
// 0.3^2, gear 50, rotor 3.3e-5 kg m^2, motor damping 1e-4 N m s/rad, 0.0525 N m/A.
TEST_F(InverseModelTest, PendulumWithGearAndGravity) {
  const model::Model pendulum =
      model::read_model(PLUMBLINE_ROOT "/tests/robots/pendulum/model.yaml", effects::Catalogue::all());
  const KnownMotion swing{0.8, 0.4, 0.1, 2.0};
  const Eigen::ArrayXd arm = 0.144 * swing.a.array() + 1.2 * 9.80665 * 0.3 * swing.q.array().sin();
  const Eigen::VectorXd torque = arm / 50.0 + 3.3e-5 * 50.0 * swing.a.array() + 1e-4 * 50.0 * swing.v.array();
  const InverseModel inverse =
      inverse_model(pendulum, swing.trial("drive", 50.0 * swing.q, torque / 0.0525), {});
  ASSERT_EQ(inverse.not_available, "");
  EXPECT_EQ(inverse.motors.at(0).unit, "N m");
  EXPECT_LT(inverse.motors.at(0).error_percent(), kDifferences);
  EXPECT_NEAR(inverse.motors[0].velocity.maxCoeff(), 50.0 * swing.v.maxCoeff(), 0.5);
}

// A count of 1 mm at 1 kHz, low-passed at 40 Hz and differenced twice: white noise of standard deviation s
// has the density 2 s^2 T up to half the sample rate, so that the acceleration's is s sqrt(2 T (2 pi)^4
// f^5/5) below f. The filters are no walls, hence half as much either way.
TEST_F(InverseModelTest, WhatACoarseEncoderAloneMakesOfTheForce) {
  model::Sensor& sensor = carriage.sensors.front();
  sensor.resolution = 1e-3;
  sensor.noise = 0.0;
  const Trial trial = motion.trial("q", motion.q, force / slider::kGain);
  const InverseModel inverse = inverse_model(carriage, trial, {});
  const double s = 1e-3 / std::sqrt(12.0);
  const double acceleration = s * std::sqrt(2.0 * 1e-3 * std::pow(2.0 * M_PI, 4) * std::pow(40.0, 5) / 5.0);
  const std::vector<double> floors = force_floors(carriage, trial, inverse, {});
  ASSERT_EQ(floors.size(), 1U);
  EXPECT_NEAR(floors[0], slider::kMass * acceleration, 0.5 * slider::kMass * acceleration);
  sensor.resolution = 1e-6;
  EXPECT_NEAR(force_floors(carriage, trial, inverse, {})[0], 1e-3 * floors[0], 1e-6 * floors[0]);
}

TEST_F(InverseModelTest, SaysWhyItIsNotAvailable) {
  const Trial trial = motion.trial("q", motion.q, force / slider::kGain);
  const model::Model bare = carriage;
  add("actuator_lag@drive:time_constant=0.01");
  EXPECT_NE(inverse_model(carriage, trial, {}).not_available.find("hidden states"), std::string::npos);
  carriage = bare;
  add("cable_stretch@carriage:stiffness=1e5,damping=100");
  EXPECT_EQ(inverse_model(carriage, trial, {}).not_available,
            "2 independent positions but 1 motor that can move");
  Trial without = trial;
  without.commands.clear();
  EXPECT_EQ(inverse_model(bare, without, {}).not_available, "the command of motor drive was not recorded");
}

}  // namespace
}  // namespace plumbline::validation
