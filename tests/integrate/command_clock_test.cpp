// Commands of a record whose clock is not that of the measurements, against closed forms.
#include "simulator/integrate/command_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "simulator/effects/clock_drift.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::integrate {
namespace {

constexpr double kPeriod = 1e-3;  // s

Eigen::MatrixXd ramp(Eigen::Index samples) {
  Eigen::MatrixXd u(1, samples);
  u.row(0) = Eigen::RowVectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1));
  return u;
}

// Of a ramp that is held over samples, u = k on [k T, (k + 1) T), the mean over sample k is k less the
// lateness in samples, however late it is, but for what the drift changes within a sample, and between the
// pulses of neighbouring ones: half of it each.
TEST(CommandClock, ARampIsLateByTheDelayOfTheMoment) {
  const Eigen::MatrixXd u = ramp(2000);
  const effects::ClockError clock{2.3e-3, 4e-3};
  for (const Eigen::Index k : {50, 300, 1234}) {
    const double late = clock.offset + clock.drift * (static_cast<double>(k) + 0.5) * kPeriod;
    const ClockedCommand command = clocked_command(u, 0, k, kPeriod, clock);
    EXPECT_NEAR(command.held, static_cast<double>(k) - late / kPeriod, clock.drift) << k;
    EXPECT_NEAR(command.slope, -1.0 / kPeriod, 2.1 * clock.drift / kPeriod) << k;
  }
}

TEST(CommandClock, ACommandMayComeEarly) {
  const ClockedCommand command = clocked_command(ramp(100), 0, 50, kPeriod, {-0.4e-3, 0.0});
  EXPECT_NEAR(command.held, 50.4, 1e-12);
  EXPECT_NEAR(clocked_command(ramp(100), 0, 99, kPeriod, {-5e-3, 0.0}).held, 99.0, 0.0) << "the last holds";
  EXPECT_NEAR(clocked_command(ramp(100), 0, 0, kPeriod, {5e-3, 0.0}).held, 0.0, 0.0) << "the first holds";
}

TEST(CommandClock, ARightClockChangesNothing) {
  const Eigen::MatrixXd u = Eigen::MatrixXd::Random(2, 50);
  EXPECT_EQ(on_clock_of_measurements(u, kPeriod, std::vector<effects::ClockError>(2)), u);
  EXPECT_FALSE(is_any_wrong(std::vector<effects::ClockError>(2)));
}

constexpr const char* kSkeleton = R"(<mujoco><option gravity="0 0 0"/><worldbody>
  <body name="wheel" pos="0 0 1"><joint name="axle" axis="0 0 1"/>
    <inertial pos="0 0 0" mass="1" diaginertia="0.1 0.1 0.015"/></body>
</worldbody></mujoco>)";

constexpr const char* kModel = R"(plumbline: model/1
robot: wheel
skeleton: wheel.xml
coordinates: {axle: {of: {axle: 1}}}
motors:
  drive: {command_unit: N m, rotor_inertia: {value: 5e-3, unit: kg m^2, assumed: test}}
ratios:
  axle: {motor: drive, ratio: {value: 1, unit: "1", assumed: test}}
sensors:
  axle:  {measures: axle, resolution: {value: 1e-4, unit: rad, assumed: test}}
effects:
  - effect: clock_drift
    at: drive
    values: {offset: {value: 4, unit: ms, assumed: test}, drift: {value: VALUE, unit: s/s, assumed: test}}
)";

model::Model wheel(const test::TemporaryFolder& folder, const std::string& drift) {
  std::string text = kModel;
  text.replace(text.find("VALUE"), 5, drift);
  folder.write("wheel.xml", kSkeleton);
  return model::read_model(folder.write("model.yaml", text), model::known_effects());
}

// A torque that is commanded from t_1 on accelerates a free wheel from the instant t at which
// t - offset - drift t = t_1, that is t = (t_1 + offset)/(1 - drift): its angle at the end T is
// u/(2 J) (T - t)^2.
TEST(CommandClock, AStepBeginsWhenItsClockSays) {
  const test::TemporaryFolder folder;
  for (const double drift : {0.02, -0.02}) {
    const model::Model model = wheel(folder, drift > 0.0 ? "0.02" : "-0.02");
    model::Plant plant(model, {});
    constexpr Eigen::Index kSamples = 1001;
    Eigen::MatrixXd commands = Eigen::MatrixXd::Zero(1, kSamples);
    commands.rightCols(kSamples - 600).setConstant(0.5);
    run::CommandedOptions options;
    options.integrator.set_tolerance(1e-10);
    const run::CommandedRun run =
        run::run_commands(plant, Eigen::Vector2d::Zero(), commands, kPeriod, 0.0, {}, nullptr, options);
    EXPECT_EQ(run.commands, commands) << "what is recorded is what was commanded";
    const double begins = (0.6 + 0.004) / (1.0 - drift);
    const double angle = 0.5 / (2.0 * 0.02) * std::pow(1.0 - begins, 2);
    EXPECT_NEAR(run.outputs(0, kSamples - 1), angle, 1e-8) << drift;
  }
}

// Also as far as a jump in the midst of a sample: with a constant lateness of 4.3 samples there is no error
// of the instant, and the angle is that of the exact motion to the integrator's.
TEST(CommandClock, AJumpMovesAsFarAsItDoesInTheMidstOfASample) {
  const test::TemporaryFolder folder;
  model::Plant plant(wheel(folder, "0"), {});
  plant.set_value({0, 0}, 4.3e-3);
  Eigen::MatrixXd commands = Eigen::MatrixXd::Zero(1, 201);
  commands.rightCols(101).setConstant(0.5);
  run::CommandedOptions options;
  options.integrator.set_tolerance(1e-12);
  const run::CommandedRun run =
      run::run_commands(plant, Eigen::Vector2d::Zero(), commands, kPeriod, 0.0, {}, nullptr, options);
  EXPECT_NEAR(run.outputs(0, 200), 0.5 / (2.0 * 0.02) * std::pow(0.1 - 0.0043, 2), 1e-10);
}

// A controller gives its commands when they are needed.
TEST(CommandClock, AControllerHasNoSecondClock) {
  const test::TemporaryFolder folder;
  const model::Model model = wheel(folder, "0.02");
  model::Plant plant(model, {});
  const Eigen::MatrixXd commands = Eigen::MatrixXd::Constant(1, 101, 0.5);
  const run::SampledController passes = [](Eigen::Index k, double, const Eigen::VectorXd&, double* u) {
    *u = k < 50 ? 0.0 : 0.5;
  };
  const run::CommandedRun run =
      run::run_commands(plant, Eigen::Vector2d::Zero(), commands, kPeriod, 0.0, passes, nullptr, {});
  EXPECT_NEAR(run.outputs(0, 100), 0.5 / (2.0 * 0.02) * 0.05 * 0.05, 1e-7);
}

TEST(CommandClock, BadValuesAreRefusedInOneLine) {
  const test::TemporaryFolder folder;
  EXPECT_THAT(test::refusal([&] { wheel(folder, "0.5"); }), testing::HasSubstr("a value from -0.1 to 0.1"));
}

TEST(ClockDrift, SaysWhatItsParametersAre) {
  const double values[] = {0.01, -2e-5};
  const effects::ClockError clock = effects::ClockDrift().clock(values);
  EXPECT_EQ(clock.offset, 0.01);
  EXPECT_EQ(clock.drift, -2e-5);
}

}  // namespace
}  // namespace plumbline::integrate
