#include "validation/identify/closed_loop/closed_loop.h"

#include "tests/identify/closed_loop/slider.h"
#include "tests/identify/trial/fixture.h"

namespace plumbline::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kP = 20.0;  // 1/s
constexpr double kV = 40.0;  // V s/m
constexpr Eigen::Index kSamples = 4000;

/// The loop by its own equations: exact motion between samples, velocity over two samples, pulses added.
Trial recorded_loop(double pulse_factor = 1.0) {
  Trial trial;
  trial.name = "loop";
  trial.period = slider::kPeriod;
  trial.time = Eigen::VectorXd::LinSpaced(kSamples, 0.0, slider::kPeriod * (kSamples - 1));
  Controller c{"cascade_pd", "drive", "q", kP, kV, 0.0, 2, {}, {}};
  c.reference.resize(kSamples);
  c.disturbance.resize(kSamples);
  Eigen::VectorXd y(kSamples);
  Eigen::VectorXd u(kSamples);
  slider::State state;
  for (Eigen::Index k = 0; k < kSamples; ++k) {
    const double t = trial.time[k];
    const double moving = std::max(0.0, t - 0.03);  // at rest while the start is estimated
    c.reference[k] = 0.1 * (1.0 - std::cos(2.0 * kPi * 0.7 * moving)) * std::exp(-0.1 * moving);
    c.disturbance[k] = std::fmod(t, 1.0) > 0.6 ? 3.0 : 0.0;
    y[k] = state.position;
    const double before = k > 1 ? y[k - 2] : 0.0;
    u[k] = kV * (kP * (c.reference[k] - y[k]) - (y[k] - before) / (2.0 * slider::kPeriod)) +
           pulse_factor * c.disturbance[k];
    state = state.after(slider::kGain * u[k]);
  }
  trial.measured.push_back({"q", "y", "m", y});
  trial.commands.push_back({"drive", "u", "V", u});
  trial.controllers.push_back(c);
  return trial;
}

/// The trial from a sample on, so that it starts in motion.
Trial from_sample(Trial trial, Eigen::Index first) {
  const Eigen::Index n = trial.samples() - first;
  for (Eigen::VectorXd* signal : {&trial.time, &trial.measured[0].values, &trial.commands[0].values,
                                  &trial.controllers[0].reference, &trial.controllers[0].disturbance}) {
    *signal = signal->tail(n).eval();
  }
  return trial;
}

class ClosedLoopTest : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    carriage = slider::read(folder);
  }
  LoopError only(const Trial& trial) const {
    const ClosedLoop result = closed_loop(carriage, trial, {});
    EXPECT_EQ(result.not_available, "");
    return result.loops.empty() ? LoopError() : result.loops.front();
  }
  model::Model carriage;
};

TEST_F(ClosedLoopTest, FollowsTheExactLoop) {
  const LoopError error = only(recorded_loop());
  EXPECT_EQ(error.motor, "drive");
  EXPECT_EQ(error.force_unit, "N");
  // The integrator's tolerance of 1e-6, and position times gain 800 V/m in the force.
  EXPECT_LT(error.position_percent, 1e-4);
  EXPECT_LT(error.force_percent, 1e-3);
  EXPECT_LT(error.equation_rms, 1e-12);
  EXPECT_NEAR(error.disturbance_factor, 1.0, 1e-12);
}

TEST_F(ClosedLoopTest, StartsInMotion) {
  const LoopError error = only(from_sample(recorded_loop(), 500));
  EXPECT_LT(error.position_percent, 0.01);  // the start comes from a parabola through 13 samples
  EXPECT_LT(error.force_percent, 0.05);
}

TEST_F(ClosedLoopTest, RelativeErrorsAreTheNormsRatio) {
  Trial trial = recorded_loop();
  trial.commands[0].values *= 1.1;
  trial.measured[0].values *= 0.98;
  const LoopError error = only(trial);
  EXPECT_NEAR(error.force_percent, 100.0 * 0.1 / 1.1, 1e-2);
  EXPECT_NEAR(error.position_percent, 100.0 * 0.02 / 0.98, 1e-2);
}

TEST_F(ClosedLoopTest, DisturbanceOfAnotherSizeIsSeenInTheControllersEquation) {
  const Trial trial = recorded_loop(1.0139);
  const LoopError error = only(trial);
  EXPECT_NEAR(error.disturbance_factor, 1.0139, 1e-9);
  const double rms = std::sqrt(trial.controllers[0].disturbance.squaredNorm() / kSamples);
  EXPECT_NEAR(error.equation_rms, 0.0139 * rms, 1e-4 * rms);  // without the first two samples
}

TEST_F(ClosedLoopTest, WrongDifferenceIsSeenInTheControllersEquation) {
  Trial trial = recorded_loop();
  trial.controllers[0].velocity_over = 1;
  const LoopError error = only(trial);
  // The difference over one sample is half a period newer: kv times half a period times the acceleration.
  const Eigen::VectorXd& y = trial.measured[0].values;
  const Eigen::Index n = kSamples - 2;
  const Eigen::VectorXd a =
      (y.tail(n) - 2.0 * y.segment(1, n) + y.head(n)) / (slider::kPeriod * slider::kPeriod);
  const double expected = kV * 0.5 * slider::kPeriod * std::sqrt(a.squaredNorm() / static_cast<double>(n));
  EXPECT_NEAR(error.equation_rms, expected, 1e-9 * expected);
  EXPECT_GT(error.force_percent, 0.1);
}

TEST_F(ClosedLoopTest, MissingFrictionShowsInTheForce) {
  Trial trial = recorded_loop();
  const double before = only(trial).force_percent;
  carriage.effects[0].values[0].value = 20.0;
  EXPECT_GT(only(trial).force_percent, 100.0 * before);
}

TEST_F(ClosedLoopTest, SaysWhyItIsNotAvailable) {
  Trial trial = recorded_loop();
  trial.controllers.clear();
  EXPECT_EQ(closed_loop(carriage, trial, {}).not_available, "no controller is known");
  trial = recorded_loop();
  trial.commands.clear();
  EXPECT_NE(closed_loop(carriage, trial, {}).not_available.find("drive was not recorded"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::validation
