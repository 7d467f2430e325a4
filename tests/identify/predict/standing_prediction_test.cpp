// Windows of a robot that stands on soft ground and logs an inertial unit at a high rate: tolerances from the
// sensors' floors, and deviations that are carried sample by sample.
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "tests/trace/temporary_folder.h"
#include "validation/identify/fit/free_parameters.h"
#include "validation/identify/predict/tolerance.h"
#include "validation/identify/predict/windows.h"

namespace plumbline::validation {
namespace {

/// 7 kg on four feet, 0.3 m below the trunk, with a tail that a motor swings.
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
  - {effect: viscous, at: wag, values: {damping: {value: 0.3, unit: N m s/rad, uncertainty: 50 %, assumed: test}}}
  - {effect: added_mass, at: trunk, values: {mass: {value: 0.4, unit: kg, uncertainty: 50 %, assumed: test}}}
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
  gyro: {gyroscope: trunk, noise: {value: 0.01, unit: rad/s}, assumed: test}
  acc:  {accelerometer: trunk, at: {value: [0.1, 0, 0], unit: m}, noise: {value: 0.1, unit: m/s^2}, assumed: test}
)";

constexpr double kPeriod = 2e-3;  // s
constexpr Eigen::Index kSamples = 200;

class StandingPrediction : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("table.xml", kTable);
    model_ = model::read_model(folder_.write("model.yaml", kModel), model::known_effects());
    trial_ = swinging();
  }

  /// The tail is swung while the table stands: what the sensors read without noise.
  Trial swinging() {
    model::Plant plant(model_, {});
    Eigen::MatrixXd commands(1, kSamples);
    for (Eigen::Index k = 0; k < kSamples; ++k) {
      commands(0, k) = 1.5 + 2.0 * std::sin(0.05 * static_cast<double>(k));
    }
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x[2] = 0.296;  // 18 N and a little on each foot
    x[plant.positions() + 6] = 0.5;
    run::CommandedOptions options;
    options.integrator.method = integrate::Method::rosenbrock;
    options.integrator.set_tolerance(1e-9);
    const run::CommandedRun run = run::run_commands(plant, x, commands, kPeriod, 0.0, {}, nullptr, options);
    states_ = run.states;
    Trial trial;
    trial.file = trial.name = "swinging";
    trial.time = run.time;
    trial.period = kPeriod;
    trial.commands = {{"drive", "u", "N m", commands.row(0).transpose(), {}}};
    for (std::size_t s = 0; s < model_.sensors.size(); ++s) {
      trial.measured.push_back(
          {model_.sensors[s].name, "", "", run.outputs.row(static_cast<Eigen::Index>(s))});
    }
    return trial;
  }

  PredictOptions at(double relative) const {
    PredictOptions options;
    options.relative_tolerance = relative;
    return options;
  }

  test::TemporaryFolder folder_;
  model::Model model_;
  Trial trial_;
  Eigen::MatrixXd states_;
};

// Of the joint: three hundredths of the encoder's floor, and for its rate what becomes that over the window.
// Heights show by the accelerometer alone, because the ground presses the feet.
TEST_F(StandingPrediction, ToleranceIsAShareOfWhatASensorShows) {
  model::Plant plant(model_, {});
  const double command = 1.5;
  const Eigen::VectorXd x = states_.col(50);
  const int wag = model_.sensor_index("wag");
  const double floor = model_.sensors[static_cast<std::size_t>(wag)].floor();
  const Eigen::VectorXd encoder = tolerances_of(plant, {{wag, floor}}, x, &command, 0.25);
  EXPECT_NEAR(encoder[6], 0.03 * floor, 1e-12);
  EXPECT_NEAR(encoder[plant.positions() + 6], 0.12 * floor, 1e-12);
  EXPECT_EQ(encoder[2], 1e-2 * kRelativeTolerance) << "nothing shows how high it is";
  const int up = model_.sensor_index("acc_z");
  const Eigen::VectorXd felt = tolerances_of(plant, {{up, 0.1}}, x, &command, 0.25);
  constexpr double kStep = 1e-6;  // m
  Eigen::VectorXd above(plant.sensors()), below(plant.sensors());
  Eigen::VectorXd moved = x;
  moved[2] = x[2] + kStep;
  plant.outputs(moved.data(), above.data(), &command);
  moved[2] = x[2] - kStep;
  plant.outputs(moved.data(), below.data(), &command);
  const double slope = std::abs(above[up] - below[up]) / (2.0 * kStep);
  EXPECT_NEAR(felt[2], 0.03 * 0.1 / slope, 0.1 * felt[2]);
}

// With a fraction of the work the residuals are those of an integration that is as good as exact.
TEST_F(StandingPrediction, TheFloorsToleranceChangesNoResidual) {
  const Window window{0, 20, 100, {}, false};
  const Eigen::VectorXd x0 = states_.col(20);
  Predictor exact(model_, trial_, at(1e-10));
  Predictor fine(model_, trial_, at(kRelativeTolerance));
  Predictor ours(model_, trial_, at(0.0));
  const Eigen::VectorXd truth = exact.residual(window, x0);
  EXPECT_LT(truth.cwiseAbs().maxCoeff(), 0.01);
  fine.residual(window, x0);
  EXPECT_LT((ours.residual(window, x0) - truth).cwiseAbs().maxCoeff(), 0.2);
  EXPECT_LT(ours.evaluations(), fine.evaluations());
  std::printf("rate evaluations: %ld at 1e-5, %ld as the floors ask\n", fine.evaluations(),
              ours.evaluations());
}

// Standing, each sample is one piece: its slopes are those of whole predictions, which are one-sided
// differences that bend bristles by some percent of what sliding bends them. Along the ground it may stand
// anywhere: those columns are rounding.
TEST_F(StandingPrediction, SlopesAreThoseOfTheResiduals) {
  const Window window{0, 20, 50, {}, false};
  Eigen::VectorXd x0 = states_.col(20);
  x0.segment<3>(3) += Eigen::Vector3d(1e-3, -2e-3, 1e-3);
  const std::vector<FreeParameter> parameters =
      matching(free_parameters(model_), {"viscous@wag:damping", "added_mass@trunk:mass"});
  ASSERT_EQ(parameters.size(), 2U);
  Predictor predictor(model_, trial_, at(1e-9));
  const Linearisation ours = predictor.linearise(window, x0, parameters);
  PredictOptions by_differences = at(1e-9);
  by_differences.differences = true;
  Predictor other(model_, trial_, by_differences);
  const Linearisation theirs = other.linearise(window, x0, parameters);
  for (Eigen::Index c = 0; c < ours.Jx.cols(); ++c) {
    EXPECT_LT((ours.Jx.col(c) - theirs.Jx.col(c)).norm(), 0.06 * theirs.Jx.col(c).norm() + 0.1) << c;
  }
  for (Eigen::Index p = 0; p < 2; ++p) {
    EXPECT_GT(theirs.Jp.col(p).norm(), 1.0);
    EXPECT_LT((ours.Jp.col(p) - theirs.Jp.col(p)).norm(), 0.03 * theirs.Jp.col(p).norm()) << p;
  }
}

}  // namespace
}  // namespace plumbline::validation
