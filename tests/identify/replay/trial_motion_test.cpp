// The motion of a trial with contact: near the ground the predictor keeps more points than samples.
#include "validation/identify/replay/trial_motion.h"

#include <gtest/gtest.h>

#include "tests/identify/predict/hopper.h"
#include "validation/identify/replay/replay.h"

namespace plumbline::validation {
namespace {

class HopperMotion : public testing::Test {
 protected:
  /// Largest difference of the body's height from the recorded one over the first `samples`, m.
  double off(const TrialMotion& motion, Eigen::Index samples) const {
    const Eigen::VectorXd& recorded = trial_.measured[0].values;
    return (motion.predicted.row(0).head(samples).transpose() - recorded.head(samples)).cwiseAbs().maxCoeff();
  }
  /// Samples at which force and switch say the same: pushed and closed, or neither.
  double agreement(const TrialMotion& motion) const {
    const Eigen::VectorXd& closed = trial_.switches[0].values;
    Eigen::Index same = 0;
    for (Eigen::Index k = 0; k < closed.size(); ++k) {
      same += (motion.foot_forces[0](2, k) > 0.0) == (closed[k] > 0.0) ? 1 : 0;
    }
    return static_cast<double>(same) / static_cast<double>(closed.size());
  }

  const model::Model model_ = test::hopper();
  const Trial trial_ = test::hopper_trial(model_, "bounce");
};

// The twin is the oracle: the model that made the recording must make it again. Windows start from states
// that are estimated from counts of 1e-5 m at 1 kHz: rates to some mm/s, over a window a fraction of a
// millimetre.
TEST_F(HopperMotion, InWindowsIsTheRecordedOne) {
  const TrialMotion motion = trial_motion(model_, trial_, {});
  ASSERT_EQ(motion.predicted.cols(), trial_.samples());
  EXPECT_LT(off(motion, trial_.samples()), 1e-3);
  EXPECT_GT(agreement(motion), 0.99);
}

// In one piece an error of the start grows from bounce to bounce: only the first is looked at closely.
TEST_F(HopperMotion, InOnePieceBeginsAsTheRecordedOne) {
  const TrialMotion motion = trial_motion(model_, trial_, {0.0, nullptr});
  ASSERT_EQ(motion.predicted.cols(), trial_.samples());
  EXPECT_LT(off(motion, 500), 1e-3);
  EXPECT_GT(agreement(motion), 0.9);
}

// Newton's third law for the whole trace: over a bounce's whole recording the ground gives the momentum that
// gravity takes, but for what the body has at its ends.
TEST_F(HopperMotion, TheTraceOfAReplayHasTheGroundsForce) {
  ReplayOptions options;
  options.integrator.method = integrate::Method::rosenbrock;
  options.integrator.set_tolerance(1e-6);
  const Replay run = replay(model_, trial_, options);
  const Column* force = run.trace.find("F_toe_z");
  ASSERT_NE(force, nullptr);
  double weight = 0.0;
  for (const model::Body& body : model_.skeleton.bodies) {
    weight += body.mass * model_.skeleton.gravity.norm();
  }
  EXPECT_NEAR(force->values.mean(), weight, 0.1 * weight);  // ends: 7 kg at up to 1.5 m/s of 280 N s in 4 s
  EXPECT_EQ(run.trace.find("F_toe_x")->values.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(force->values.minCoeff(), 0.0);
}

}  // namespace
}  // namespace plumbline::validation
