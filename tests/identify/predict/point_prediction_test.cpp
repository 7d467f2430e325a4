// Predictions of orientations, gyroscopes and accelerometers of a body that floats.
#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "tests/trace/temporary_folder.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

/// A trunk that floats with a driven tail; the tail's joint is damped.
constexpr const char* kDog = R"(<mujoco><worldbody>
  <body name="trunk"><freejoint/>
    <inertial pos="0.02 0.01 -0.03" mass="6" diaginertia="0.1 0.09 0.03"/>
    <body name="tail" pos="-0.2 0 0.1"><joint name="wag" axis="0 1 0"/>
      <inertial pos="-0.2 0 0" mass="1" diaginertia="0.002 0.01 0.01"/></body></body>
</worldbody></mujoco>)";

constexpr const char* kModel = R"(plumbline: model/1
robot: dog
skeleton: dog.xml
coordinates: {wag: {of: {wag: 1}}}
motors:
  drive: {command_unit: N m, rotor_inertia: {value: 1e-3, unit: kg m^2, assumed: test}}
ratios:
  wag: {motor: drive, ratio: {value: 1, unit: "1", assumed: test}}
effects:
  - {effect: viscous, at: wag, values: {damping: {value: 0.3, unit: N m s/rad, uncertainty: 50 %, assumed: test}}}
  - {effect: imu_scale, at: acc, values: {x: {value: 1.1, unit: "1", uncertainty: 0.1, assumed: test}}}
  - effect: imu_misalignment
    at: acc
    values: {y: {value: 0.2, unit: rad, uncertainty: 0.1, assumed: test}}
  - {effect: imu_bias, at: gyro, values: {z: {value: 0.3, unit: rad/s, uncertainty: 0.1, assumed: test}}}
  - {effect: added_mass, at: trunk, values: {mass: {value: 0.4, unit: kg, assumed: test}}}
sensors:
  wag:  {measures: wag, resolution: {value: 1e-4, unit: rad, assumed: test}}
  nose: {marker: trunk, at: {value: [0.3, 0, 0], unit: m}, noise: {value: 1, unit: mm}, assumed: test}
  turn: {orientation: trunk, noise: {value: 2, unit: mrad}, assumed: test}
  gyro: {gyroscope: trunk, noise: {value: 0.01, unit: rad/s}, assumed: test}
  acc:  {accelerometer: tail, at: {value: [-0.3, 0, 0], unit: m}, noise: {value: 0.1, unit: m/s^2}, assumed: test}
)";

class PointPrediction : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("dog.xml", kDog);
    model_ = model::read_model(folder_.write("model.yaml", kModel), model::known_effects());
  }

  /// A free flight in which the tail is driven: what the sensors read without noise.
  Trial flight(double command_size = 2.0) {
    model::Plant plant(model_, {});
    constexpr Eigen::Index kSamples = 120;
    constexpr double kPeriod = 2e-3;
    Eigen::MatrixXd commands(1, kSamples);
    for (Eigen::Index k = 0; k < kSamples; ++k) {
      commands(0, k) = command_size * std::sin(0.1 * static_cast<double>(k));
    }
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x.segment(plant.positions(), 7) << 0.3, -0.2, 1.0, 2.0, -0.5, 1.5, 1.0;
    run::CommandedOptions options;
    options.integrator.set_tolerance(1e-10);
    const run::CommandedRun run = run::run_commands(plant, x, commands, kPeriod, 0.0, {}, nullptr, options);
    Trial trial;
    trial.file = trial.name = "flight";
    trial.time = run.time;
    trial.period = kPeriod;
    trial.commands = {{"drive", "u", "N m", commands.row(0).transpose(), {}}};
    for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
      trial.measured.push_back(
          {model_.sensors[s].name, "", "", run.outputs.row(static_cast<Eigen::Index>(s))});
    }
    return trial;
  }

  test::TemporaryFolder folder_;
  model::Model model_;
};

TEST_F(PointPrediction, TheTruthLeavesNothing) {
  const Trial trial = flight();
  PredictOptions options;
  options.relative_tolerance = 1e-9;
  Predictor predictor(model_, trial, options);
  for (const Eigen::Index first : {Eigen::Index{0}, Eigen::Index{40}}) {
    const Window window{0, first, 60, {}, false};
    // The start is read off the sensors of pose by a quadratic over 25 samples, which misses some of the
    // tail's swing.
    Eigen::VectorXd x0 = predictor.initial_state(window);
    EXPECT_LT(predictor.residual(window, x0).cwiseAbs().maxCoeff(), 500.0);
    constexpr int kSteps = 6;
    for (int step = 0; step < kSteps; ++step) {
      const Linearisation at = predictor.linearise(window, x0, {});
      x0 += at.Jx.colPivHouseholderQr().solve(at.r);
    }
    EXPECT_LT(predictor.residual(window, x0).cwiseAbs().maxCoeff(), 0.01);
  }
}

// Also where the residuals are large: half a radian away.
TEST_F(PointPrediction, SlopesAreThoseOfTheResiduals) {
  const Trial trial = flight();
  PredictOptions options;
  options.relative_tolerance = 1e-10;
  Predictor predictor(model_, trial, options);
  const Window window{0, 20, 25, {}, false};
  Eigen::VectorXd x0 = predictor.initial_state(window);
  x0.segment<3>(3) += Eigen::Vector3d(0.3, -0.2, 0.25);
  const std::vector<FreeParameter> parameters =
      matching(free_parameters(model_),
               {"viscous@wag:damping", "imu_scale@acc:x", "imu_misalignment@acc:y", "imu_bias@gyro:z"});
  ASSERT_EQ(parameters.size(), 4U);
  const Linearisation ours = predictor.linearise(window, x0, parameters);
  PredictOptions by_differences = options;
  by_differences.differences = true;
  Predictor other(model_, trial, by_differences);
  const Linearisation theirs = other.linearise(window, x0, parameters);
  // Of the linearisation over pieces: its error falls as the sample's length.
  for (Eigen::Index c = 0; c < ours.Jx.cols(); ++c) {
    EXPECT_LT((ours.Jx.col(c) - theirs.Jx.col(c)).norm(), 0.02 * theirs.Jx.col(c).norm() + 1e-6) << c;
  }
  for (Eigen::Index p = 0; p < ours.Jp.cols(); ++p) {
    EXPECT_LT((ours.Jp.col(p) - theirs.Jp.col(p)).norm(), 0.02 * theirs.Jp.col(p).norm())
        << parameters[static_cast<std::size_t>(p)].label;
  }
}

}  // namespace
}  // namespace plumbline::validation
