#include "validation/identify/standard/torque_stage.h"

#include <gtest/gtest.h>

#include "tests/identify/standard/double_pendulum.h"

namespace plumbline::validation {
namespace {

using pendulums::Truth;

std::string names_of(const TorqueStage& stage) {
  std::string names;
  for (const TorqueFinding& one : stage.named) {
    names += one.label() + " ";
  }
  return names;
}

/// Viscous friction at the elbow, Coulomb friction at shoulder and elbow, and noise of the recorded torques.
Truth with_friction(double viscous, const std::array<double, 2>& coulomb,
                    const std::array<double, 2>& torque_noise) {
  Truth truth;
  truth.viscous = viscous;
  truth.coulomb = coulomb;
  truth.torque_noise = torque_noise;
  return truth;
}

TorqueStage stage_of(const Truth& truth) {
  constexpr double kCutoff = 20.0;  // Hz
  return torque_stage(pendulums::stated(), effects::Catalogue::all(), pendulums::data(truth), kCutoff,
                      Policy{}, pendulums::silent);
}

TEST(TorqueStage, NamesAPayloadWithItsMassAndPlace) {
  Truth truth;
  truth.payload = 0.4;
  truth.x = 0.06;
  truth.z = -0.35;
  const TorqueStage stage = stage_of(truth);
  ASSERT_EQ(stage.named.size(), 1U) << names_of(stage);
  EXPECT_EQ(stage.named.front().label(), "payload@lower");
  const std::vector<FreeValue>& values = stage.named.front().free.values;
  std::map<std::string, double> found;
  for (const FreeValue& value : values) {
    found[value.label] = value.value;
  }
  EXPECT_NEAR(found["payload@lower:mass"], truth.payload, 0.05 * truth.payload);
  EXPECT_NEAR(found["payload@lower:x"], truth.x, 0.01);
  EXPECT_NEAR(found["payload@lower:z"], truth.z, 0.02);
}

TEST(TorqueStage, NamesFriction) {
  Truth truth;
  truth.viscous = 0.05;
  const TorqueStage stage = stage_of(truth);
  ASSERT_EQ(stage.named.size(), 1U) << names_of(stage);
  EXPECT_EQ(stage.named.front().label(), "viscous@elbow_motor");
}

// A torque that is friction nearly whole, recorded with more noise than the motion needs: a law that lets no
// torque through would leave less at the joint, but says nothing of what was recorded.
TEST(TorqueStage, NamesFrictionWhereItIsNearlyAllOfTheTorque) {
  const TorqueStage stage = stage_of(with_friction(0.0, {0.0, 40.0}, {0.0, 12.0}));
  ASSERT_GE(stage.named.size(), 1U) << names_of(stage);
  EXPECT_EQ(stage.named.front().label(), "coulomb@elbow_motor") << names_of(stage);
  EXPECT_NEAR(stage.named.front().free.values.back().value, 40.0, 4.0);
}

// Each is the best in some resamples; both are there, and neither is a rival of the other.
TEST(TorqueStage, NamesTwoThatAreEquallyStrong) {
  const TorqueStage stage = stage_of(with_friction(0.0, {0.6, 0.5}, {1.0, 1.0}));
  EXPECT_EQ(names_of(stage), "coulomb@shoulder_motor coulomb@elbow_motor ");
  for (const TorqueFinding& one : stage.named) {
    EXPECT_TRUE(one.rivals.empty()) << one.rivals.front().label();
  }
}

// Half of the elbow's torque is noise, and friction lowers its error by a few per cent: at that motor,
// whatever the other one has.
TEST(TorqueStage, NamesFrictionAtEachOfTwoMotors) {
  const TorqueStage stage = stage_of(with_friction(0.1, {0.4, 0.5}, {1.0, 2.5}));
  EXPECT_EQ(names_of(stage), "coulomb@elbow_motor coulomb@shoulder_motor ");
}

// Ripple of several times the torque itself would suit torques that are mostly noise, too: no motor has it.
TEST(TorqueStage, NamesFrictionWhereMuchOfTheTorqueIsNoise) {
  const TorqueStage stage = stage_of(with_friction(0.2, {0.6, 3.0}, {1.0, 6.0}));
  EXPECT_EQ(names_of(stage), "coulomb@elbow_motor coulomb@shoulder_motor ");
}

TEST(TorqueStage, NamesNothingWhereNothingIsMissing) { EXPECT_EQ(names_of(stage_of({})), ""); }

// A mass that the model knows to 10 % is not an effect, however much it explains.
TEST(TorqueStage, NamesNothingForANumberWithinWhatIsStated) {
  Truth truth;
  truth.lower_mass = 0.65;
  EXPECT_EQ(names_of(stage_of(truth)), "");
}

}  // namespace
}  // namespace plumbline::validation
