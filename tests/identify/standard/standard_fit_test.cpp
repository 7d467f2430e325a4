#include "validation/identify/standard/standard_fit.h"

#include <gtest/gtest.h>

#include "tests/identify/standard/double_pendulum.h"

namespace plumbline::validation {
namespace {

using pendulums::Truth;

double value_of(const StandardFit& fit, const std::string& label) {
  for (const FreeValue& value : fit.free.values) {
    if (value.label == label) {
      return value.value;
    }
  }
  ADD_FAILURE() << "no value " << label;
  return 0.0;
}

StandardFit fit_of(const Truth& truth) {
  return standard_fit(pendulums::stated(), pendulums::data(truth), {}, pendulums::silent);
}

// The program's mass matrix, gravity and Coriolis forces against Lagrange's equations by hand: what is left
// are central differences over 2 ms of 2 Hz and the halves of held commands.
TEST(StandardFit, LeavesARightModelNoTorque) {
  for (const TorqueError& torque : fit_of({}).torques) {
    EXPECT_LT(torque.before, 5e-3 * torque.recorded) << torque.motor;
  }
}

TEST(StandardFit, FindsFrictionAndPredictsBetter) {
  Truth truth;
  truth.viscous = 0.05;
  const StandardFit fit = fit_of(truth);
  EXPECT_NEAR(value_of(fit, "viscous@elbow_motor:damping"), truth.viscous, 0.1 * truth.viscous);
  EXPECT_LT(fit.after.held_out, 0.5 * fit.before.held_out);
}

// Torques tell combinations of masses and centres of mass only; what they tell must be right.
TEST(StandardFit, ExplainsTheTorquesOfAHeavierLink) {
  Truth truth;
  truth.lower_mass = 0.7;
  for (const TorqueError& torque : fit_of(truth).torques) {
    EXPECT_GT(torque.before, 0.02 * torque.recorded) << torque.motor;
    EXPECT_LT(torque.after, 0.1 * torque.before) << torque.motor;
  }
}

TEST(StandardFit, KeepsEveryValuePhysical) {
  Truth truth;
  truth.payload = 2.0;
  truth.z = -0.6;  // farther out than the lower link reaches
  const StandardFit fit = fit_of(truth);
  for (const FreeValue& value : fit.free.values) {
    EXPECT_GE(value.value, value.lower) << value.label;
    EXPECT_LE(value.value, value.upper) << value.label;
  }
}

TEST(StandardFit, NeedsATrainTrial) {
  const Data data({pendulums::trial({}, Role::held_out)}, PredictOptions{});
  EXPECT_ANY_THROW(standard_fit(pendulums::stated(), data, {}, pendulums::silent));
}

}  // namespace
}  // namespace plumbline::validation
