// What was commanded before the first row, against closed forms: a wheel that was held without torque and is
// let go under a constant command, behind a delay and behind a lag.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"
#include "validation/identify/predict/windows.h"
#include "validation/identify/replay/replay.h"

namespace plumbline::validation {
namespace {

constexpr const char* kWheel = R"(<mujoco><option gravity="0 0 0"/><worldbody>
  <body name="wheel"><joint name="axle" axis="0 0 1"/>
    <inertial pos="0 0 0" mass="1" diaginertia="0.4 0.4 0.4"/>
  </body></worldbody></mujoco>)";
constexpr double kTorque = 0.6, kInertia = 0.5, kDelay = 0.0173, kLag = 0.03;  // inertia: with the rotor's
constexpr double kPeriod = 0.005;
constexpr int kSamples = 40;

class Before : public testing::Test {
 protected:
  model::Model wheel(const std::string& effect) const {
    folder_.write("wheel.xml", kWheel);
    const std::string text =
        "plumbline: model/1\nrobot: wheel\nskeleton: wheel.xml\ncoordinates: {axle: {of: {axle: 1}}}\n"
        "motors: {drive: {command_unit: N m, rotor_inertia: {value: 0.1, unit: kg m^2, assumed: t}}}\n"
        "ratios: {axle: {motor: drive, ratio: {value: 1, unit: '1', assumed: t}}}\n"
        "sensors: {axle: {measures: axle, resolution: {value: 1e-5, unit: rad, assumed: t}, assumed: t}}\n"
        "effects: [{effect: " +
        effect + "}]\n";
    return model::read_model(folder_.write("model.yaml", text), model::known_effects());
  }
  Trial trial(const model::Model& of, const std::string& before) const {
    std::ostringstream rows;
    rows << "t [s],u [N m],q [rad]\n";
    for (int k = 0; k < kSamples; ++k) {
      rows << kPeriod * k << ',' << kTorque << ",0\n";
    }
    folder_.write("data.csv", rows.str());
    const std::string file =
        folder_.write("trial.yaml",
                      "plumbline: trial/1\ntitle: let go\nmodel: model.yaml\nrole: train\ndata: data.csv\n"
                      "time: {column: t}\ncommands: {drive: {column: u" +
                          before + "}}\nmeasured: {axle: {column: q}}\n");
    return read_trial(file, of);
  }
  /// Largest difference of the simulated angle from one that is given over time.
  template <typename Angle>
  double off(const model::Model& of, const std::string& before, const Angle& angle) const {
    ReplayOptions options;
    options.integrator.set_tolerance(1e-10);
    const Replay run = replay(of, trial(of, before), options);
    const Eigen::VectorXd& q = run.trace.find("q_axle")->values;
    double most = 0.0;
    for (int k = 0; k < kSamples; ++k) {
      most = std::max(most, std::abs(q[k] - angle(kPeriod * k)));
    }
    return most;
  }

  test::TemporaryFolder folder_;
};

const std::string kZero = ", before: {value: 0, unit: N m}";
const std::string kDelayed =
    "command_delay, at: drive, values: {delay: {value: 0.0173, unit: s, assumed: t}}";
const std::string kLagging =
    "actuator_lag, at: drive, values: {time_constant: {value: 0.03, unit: s, assumed: t}}";

double at_once(double t) { return 0.5 * kTorque / kInertia * t * t; }

TEST_F(Before, NothingIsOnItsWayBehindADelay) {
  const auto late = [](double t) { return at_once(std::max(0.0, t - kDelay)); };
  EXPECT_LT(off(wheel(kDelayed), kZero, late), 1e-9);
  EXPECT_LT(off(wheel(kDelayed), "", at_once), 1e-9);  // left out: the first row's command
}

// Twice the command before, none after: the wheel turns on for the delay.
TEST_F(Before, AnotherCommandIsOnItsWay) {
  const auto twice = [](double t) {
    const double until = std::min(t, kDelay);
    return 2.0 * at_once(until) + 2.0 * kTorque / kInertia * until * (t - until) + at_once(t - until);
  };
  EXPECT_LT(off(wheel(kDelayed), ", before: {value: 1200, unit: N mm}", twice), 1e-9);
}

// Torque u (1 - exp(-t/T)), integrated twice.
TEST_F(Before, ALagBeginsWithoutTorque) {
  const auto rising = [](double t) {
    return kTorque / kInertia * (0.5 * t * t - kLag * t + kLag * kLag * -std::expm1(-t / kLag));
  };
  EXPECT_LT(off(wheel(kLagging), kZero, rising), 1e-8);
  EXPECT_LT(off(wheel(kLagging), "", at_once), 1e-8);
}

// Windows of a search begin as simulations do.
TEST_F(Before, TheFirstWindowBeginsWithIt) {
  const model::Model lagging = wheel(kLagging);
  const Trial let_go = trial(lagging, kZero);
  Predictor predictor(lagging, let_go, {});
  const Window all{0, 0, kSamples};
  const Eigen::MatrixXd q = predictor.predict(all, predictor.initial_state(all));
  const double t = kPeriod * (kSamples - 1);
  const double expected =
      kTorque / kInertia * (0.5 * t * t - kLag * t + kLag * kLag * -std::expm1(-t / kLag));
  EXPECT_NEAR(q(kSamples - 1, 0), expected, 1e-6);
}

TEST_F(Before, AUnitThatIsNoneIsRefused) {
  const model::Model of = wheel(kLagging);
  const std::string message = test::refusal([&] { trial(of, ", before: {value: 0, unit: m}"); });
  EXPECT_NE(message.find("trial.yaml:7: commands.drive.before.unit"), std::string::npos) << message;
}

}  // namespace
}  // namespace plumbline::validation
