// A floating robot whose base no sensor shows is put on the ground by its feet.
#include "validation/identify/predict/stance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/positions_from.h"
#include "simulator/model/robot_file.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::validation {
namespace {

/// 7 kg on four points, 0.3 m below the trunk, and a joint with an encoder.
constexpr const char* kTable = R"(<mujoco><option gravity="0 0 -10"/><worldbody>
  <body name="trunk"><freejoint/>
    <inertial pos="0 0 0" mass="6" diaginertia="0.1 0.09 0.03"/>
    <body name="tail" pos="-0.2 0 0.1"><joint name="wag" axis="0 1 0"/>
      <inertial pos="-0.2 0 0" mass="1" diaginertia="0.002 0.01 0.01"/></body></body>
</worldbody></mujoco>)";

constexpr const char* kModel = R"(plumbline: model/1
robot: table
skeleton: table.xml
coordinates: {wag: {of: {wag: 1}}}
motors:
  drive: {command_unit: N m, rotor_inertia: {value: 1e-3, unit: kg m^2, assumed: test}}
ratios:
  wag: {motor: drive, ratio: {value: 1, unit: "1", assumed: test}}
feet:
  FL: {link: trunk, value: [0.2, 0.1, -0.3], unit: m, group: feet, assumed: test}
  FR: {link: trunk, value: [0.2, -0.1, -0.3], unit: m, group: feet, assumed: test}
  RL: {link: trunk, value: [-0.2, 0.1, -0.3], unit: m, group: feet, assumed: test}
  RR: {link: trunk, value: [-0.2, -0.1, -0.3], unit: m, group: feet, assumed: test}
effects:
  - effect: ground_normal
    at: feet
    values:
      stiffness: {value: 5000, unit: N, assumed: test}
      damping: {value: 100, unit: N s/m, assumed: test}
      exponent: {value: 1, unit: "1", assumed: "a spring"}
  - effect: ground_friction
    at: feet
    values:
      bristle_stiffness: {value: 2000, unit: 1/m, assumed: test}
      bristle_damping: {value: 1, unit: s/m, assumed: test}
      friction: {value: 0.8, unit: "1", assumed: test}
sensors:
  wag:  {measures: wag, resolution: {value: 1e-4, unit: rad, assumed: test}}
  turn: {orientation: trunk, noise: {value: 2, unit: mrad}, assumed: test}
)";

constexpr double kWeight = 70.0;       // N
constexpr double kStiffness = 5000.0;  // N/m
constexpr double kHeight = 0.3;        // m

class Standing : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("table.xml", kTable);
    model_ = model::read_model(folder_.write("model.yaml", kModel), model::known_effects());
  }

  std::vector<Eigen::Index> unseen(const model::Plant& plant) const {
    std::vector<model::Observation> channels;
    for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
      channels.push_back(model::observe_sensor(plant, static_cast<int>(s)));
    }
    return unseen_positions(model::PositionsFrom(plant, channels).deviations());
  }

  test::TemporaryFolder folder_;
  model::Model model_;
};

TEST_F(Standing, EncoderAndOrientationLeaveThePlaceOpen) {
  const model::Plant plant(model_, {});
  EXPECT_EQ(unseen(plant), (std::vector<Eigen::Index>{0, 1, 2}));
}

// Level: each foot carries a quarter. From a start far in the ground as from one in the air.
TEST_F(Standing, TheGroundCarriesTheWeight) {
  model::Plant plant(model_, {});
  for (const double height : {-0.5, 0.0, 2.0}) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x[2] = height;
    stand_by_unseen(plant, unseen(plant), x);
    EXPECT_NEAR(x[2], kHeight - kWeight / (4.0 * kStiffness), 1e-9);
  }
}

// Rolled by 0.2 rad the left feet are 0.2 sin(0.2) = 40 mm above the right ones, which carry all.
TEST_F(Standing, OnlyTheLowestFeetCarry) {
  model::Plant plant(model_, {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  constexpr double kRoll = 0.2;
  x[5] = kRoll;
  stand_by_unseen(plant, unseen(plant), x);
  const double below = 0.1 * std::sin(kRoll) + kHeight * std::cos(kRoll);  // the right feet, under the trunk
  EXPECT_NEAR(x[2], below - kWeight / (2.0 * kStiffness), 1e-9);
  EXPECT_EQ(x[5], kRoll) << "what a sensor shows stays";
}

// The trunk pitches at 0.5 rad/s: its feet, 0.3 m below, are stillest where it moves forward at 0.15 m/s.
TEST_F(Standing, TheFeetThatCarryAreStill) {
  model::Plant plant(model_, {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const Eigen::Index nz = plant.positions();
  x[nz + 4] = 0.5;
  x.segment<3>(nz).setConstant(3.0);
  stand_by_unseen(plant, unseen(plant), x);
  EXPECT_NEAR(x[nz], 0.5 * kHeight, 1e-6);
  EXPECT_NEAR(x[nz + 1], 0.0, 1e-9);
  EXPECT_NEAR(x[nz + 2], 0.0, 1e-9);
  EXPECT_EQ(x[nz + 4], 0.5);
}

// Sliding bends bristles by friction over stiffness, whatever the speed; nothing else has such a bound.
TEST_F(Standing, SlidingBendsBristlesSoFar) {
  const model::Plant plant(model_, {});
  const Eigen::VectorXd bent = bent_by_sliding(plant);
  const Eigen::Index moving = 2 * plant.positions();
  ASSERT_EQ(bent.size(), moving + 8);
  for (Eigen::Index i = 0; i < bent.size(); ++i) {
    if (i < moving) {
      EXPECT_TRUE(std::isinf(bent[i]));
    } else {
      EXPECT_NEAR(bent[i], 0.8 / 2000.0, 1e-12);
    }
  }
}

}  // namespace
}  // namespace plumbline::validation
