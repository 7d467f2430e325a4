#include "validation/identify/compare/defects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::validation {
namespace {

constexpr double kMass = 95.1089;       // kg, carriage and reflected motor
constexpr double kFriction = 203.5034;  // N s/m
constexpr double kBlow = 0.613;         // s

/// A carriage on a level guide with viscous friction that coasts, and is struck once:
///   M dv/dt = -F v,  v behind the blow = v before + J / M.
Trial coasting(double impulse) {
  constexpr int kSamples = 1500;
  constexpr double kCount = 5e-8;  // m, of the model's encoder
  Trial trial;
  trial.file = "coasting/trial.yaml";
  trial.name = "coasting";
  trial.role = Role::train;
  trial.period = 1e-3;
  trial.time = Eigen::VectorXd::LinSpaced(kSamples, 0.0, (kSamples - 1) * trial.period);
  const double tau = kMass / kFriction;
  const auto coasted = [&](double speed, double time) { return speed * tau * (1.0 - std::exp(-time / tau)); };
  const double before = std::exp(-kBlow / tau);
  Eigen::VectorXd q(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    const double t = trial.time[k];
    const double x =
        t < kBlow ? coasted(1.0, t) : coasted(1.0, kBlow) + coasted(before + impulse / kMass, t - kBlow);
    q[k] = kCount * std::round(x / kCount);
  }
  Measured channel;
  channel.sensor = "q";
  channel.values = q;
  trial.measured.push_back(channel);
  Command command;
  command.motor = "drive";
  command.values = Eigen::VectorXd::Zero(kSamples);
  trial.commands.push_back(command);
  return trial;
}

std::vector<Defect> defects_of(double impulse) {
  const model::Model model = model::read_model("robots/emps/emps.yaml", model::known_effects());
  return defects(model, Data({coasting(impulse)}, PredictOptions{}));
}

TEST(Defects, NameABlowByTimePlaceAndImpulse) {
  constexpr double kImpulse = -20.0;  // N s
  const std::vector<Defect> found = defects_of(kImpulse);
  ASSERT_FALSE(found.empty());
  const Defect& blow = found.front();
  EXPECT_EQ(blow.trial, "coasting");
  EXPECT_EQ(blow.at, "carriage");
  EXPECT_TRUE(blow.is_speed);
  EXPECT_EQ(blow.unit, "m/s");
  EXPECT_NEAR(blow.time, kBlow, 0.07) << "between segments of a sixteenth of a second";
  EXPECT_LT(blow.impulse, 0.4 * kImpulse) << "the struck segment has a part of it in its own start";
  EXPECT_GT(blow.impulse, 1.1 * kImpulse);
}

TEST(Defects, AreNoneWhereNothingHappens) { EXPECT_TRUE(defects_of(0.0).empty()); }

}  // namespace
}  // namespace plumbline::validation
