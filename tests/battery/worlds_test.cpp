// The foreign worlds against what is known of them: energy, the twins of the tested simulator where nothing
// is hidden, and the hand-derived accelerations of tests/oracles.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/worlds/mujoco_rig.h"
#include "tests/battery/worlds/recorder.h"
#include "tests/battery/worlds/visibility.h"
#include "tests/oracles/leg_bench_lagrangian.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::battery::worlds {
namespace {

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

model::Model model_of(const std::string& robot) {
  return model::read_model(in_root(robot == "pendulum"    ? "tests/robots/pendulum/model.yaml"
                                   : robot == "leg_bench" ? "robots/mabel/leg_bench.yaml"
                                                          : "robots/hopper/hopper.yaml"),
                           model::known_effects());
}

validation::Experiment experiment_of(const std::string& robot, const std::string& file, double duration) {
  validation::Experiment e = validation::read_experiment(in_root(file), model_of(robot));
  const auto samples = static_cast<Eigen::Index>(std::lround(duration / e.period));
  e.time.conservativeResize(samples);
  e.duration = duration;
  for (validation::Command& c : e.commands) {
    c.values.conservativeResize(samples);
  }
  return e;
}

/// Largest difference of a reading between the world and the simulator's twin, in floors.
double farthest(const std::string& robot, const std::string& file, const std::string& hidden, double duration,
                bool mujoco, double sharper = 1.0) {
  const model::Model model = model_of(robot);
  const validation::Experiment experiment = experiment_of(robot, file, duration);
  model::Model with = model;
  Rig rig = rig_of(robot, model);
  if (!hidden.empty()) {
    with.effects.push_back(validation::parse_effect(hidden, model, model::known_effects()));
    Hidden effect = hidden_from(hidden);
    effect.values["smoothing_speed"] *= sharper;
    hide(effect, rig);
  }
  validation::TwinOptions options;
  options.quantise = false;
  const validation::Trial twin = validation::twin(with, experiment, options);
  const Recording recording = record(rig, experiment, model, mujoco ? robot : "");
  double most = 0.0;
  for (Eigen::Index k = 0; k < twin.samples(); ++k) {
    const Eigen::VectorXd shown = readings_at(rig, recording.motion, k, recording.period);
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      const double away = shown[static_cast<Eigen::Index>(s)] - twin.measured[s].values[k];
      most = std::max(most, std::abs(away) / model.find_sensor(rig.sensors[s].name)->floor());
    }
  }
  return most;
}

TEST(WorldEquations, LegMovesAsTheOtherDerivationSays) {
  const Rig rig = rig_of("leg_bench", model_of("leg_bench"));
  const Machine machine(rig, {}, Vector::Zero(2));
  const oracles::LegBenchConstants leg = oracles::mabel_left_leg();
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> draw(-1.0, 1.0);
  for (int i = 0; i < 100; ++i) {
    State x(4);
    x << draw(random), draw(random), 3.0 * draw(random), 3.0 * draw(random);
    Vector u(2);
    u << draw(random), draw(random);
    State rate(4);
    machine.rates(u, x, rate);
    const oracles::Pair angles(x[0] + x[1], x[0] - x[1]);
    const oracles::Pair rates(x[2] + x[3], x[2] - x[3]);
    const oracles::Pair expected = oracles::leg_bench_accelerations(
        leg, angles, rates, oracles::Pair(u[0], u[1]), oracles::Pair(4.316e-3, 9.844e-3));
    // The oracle's constants have six digits.
    EXPECT_NEAR(rate[2] + rate[3], expected[0], 2e-5 * (1.0 + expected.norm()));
    EXPECT_NEAR(rate[2] - rate[3], expected[1], 2e-5 * (1.0 + expected.norm()));
  }
}

// A tenth of a floor: two integrators of the same equations are closer, another equation is not.
constexpr double kSame = 0.1;

TEST(Worlds, PendulumWithNothingHiddenIsTheSimulatorsTwin) {
  EXPECT_LT(farthest("pendulum", "tests/robots/pendulum/experiments/steps.yaml", "", 1.0, false), kSame);
}

TEST(Worlds, LegWithALockedMotorAndBothFreeIsTheSimulatorsTwin) {
  EXPECT_LT(farthest("leg_bench", "robots/mabel/experiments/siso_mLS.yaml", "", 0.5, false), kSame);
  EXPECT_LT(farthest("leg_bench", "robots/mabel/experiments/mimo.yaml", "", 0.5, false), kSame);
}

TEST(Worlds, StretchingCableIsTheSimulatorsTwin) {
  EXPECT_LT(farthest("leg_bench", "robots/mabel/experiments/mimo.yaml",
                     "cable_stretch@leg_angle:stiffness=9.2,damping=0.05", 0.5, false),
            kSame);
}

// Two programs of one law: the torque that the gear passes on, which the acceleration is part of. The world's
// tanh is three times as sharp as stated.
TEST(Worlds, GearFrictionIsTheSimulatorsTwin) {
  EXPECT_LT(farthest("pendulum", "tests/robots/pendulum/experiments/steps.yaml",
                     "gear_friction@drive:coefficient=0.05,smoothing_speed=0.1", 0.5, false, 3.0),
            kSame);
  EXPECT_LT(farthest("leg_bench", "robots/mabel/experiments/mimo.yaml",
                     "gear_friction@mLS:coefficient=0.05,smoothing_speed=0.1", 0.3, false, 3.0),
            kSame);
}

// The same physics written twice: circuits and magnetisation curves here, limits of torque there; a mass and
// its spring here, a frequency and a damping ratio there.
TEST(Worlds, DrivesAndWhatRattlesAreTheSimulatorsTwin) {
  for (const char* hidden :
       {"voltage_limit@mLA:stall_torque=1.2,no_load_speed=50", "torque_saturation@mLS:sag=0.2",
        "asymmetric_spring@thigh:stiffness_above=4,stiffness_below=1,rest=0.349",
        "current_loop@mLA:time_constant=0.01,damping_ratio=0.4",
        "thermal_motor@mLA:magnet_sag=2e-3,copper_sag=3.9e-3,heating=50,winding_time=0.3,"
        "housing_time=2,share=0.3,copper=3.9e-3,ambient=293.15",
        "encoder_eccentricity@mLS:sine=0.03,cosine=-0.02,waves=1", "sensor_lag@thigh:lag=4e-4",
        "torque_ripple@mLS:sine=0.05,cosine=-0.03,cycles=12", "winding@mLA:time_constant=0.004,slope=0.02",
        "harmonic_drive@leg_angle:stiffness_soft=6,stiffness_stiff=15,windup=0.03,damping=0.05",
        "battery@world:stall_sag=0.05,speed_sag=1e-3",
        "resonator@leg_shape:inertia=0.08,frequency=6,damping_ratio=0.1",
        "clock_drift@mLA:offset=1.3e-3,drift=4e-3"}) {
    EXPECT_LT(farthest("leg_bench", "robots/mabel/experiments/mimo.yaml", hidden, 0.5, false), kSame)
        << hidden;
  }
}

// Perfectly plastic there, a little round here: some floors of the hundreds that the slip makes.
TEST(Worlds, SlippingCouplingIsNearlyTheSimulatorsTwin) {
  const std::string hidden = "slipping_coupling@leg_angle:limit=0.6,stiffness=60,damping=0.1";
  const double apart = farthest("leg_bench", "robots/mabel/experiments/mimo.yaml", hidden, 0.5, false);
  std::printf("%.2f floors\n", apart);
  EXPECT_LT(apart, 30.0);
}

// All or nothing of the way between two samples there, over a little of the speeds here: a floor of the 175
// that are lost.
TEST(Worlds, LostCountsAreNearlyTheSimulatorsTwin) {
  const std::string hidden = "lost_counts@mLS:share=0.05,limit_speed=6,width=0.02";
  const double apart = farthest("leg_bench", "robots/mabel/experiments/mimo.yaml", hidden, 1.0, false);
  std::printf("%.2f floors\n", apart);
  EXPECT_LT(apart, 3.0);
}

// Away from standstill, where one of the two is smoothed and the other not.
TEST(Worlds, GearEfficiencyIsTheSimulatorsTwin) {
  EXPECT_LT(farthest("pendulum", "tests/robots/pendulum/experiments/steps.yaml",
                     "gear_efficiency@drive:loss_driving=0.06,loss_driven=0.03,smoothing_speed=0.1", 0.5,
                     false, 3.0),
            1.0);
}

// Landings at fixed steps of 20 us: a floor, not a tenth of one.
TEST(Worlds, HopperLandsAsTheSimulatorsTwin) {
  EXPECT_LT(farthest("hopper", "robots/hopper/experiments/bounce.yaml", "", 0.5, false), 1.0);
}

TEST(Worlds, MujocosLegIsTheSimulatorsTwin) {
  if (!has_mujoco()) {
    GTEST_SKIP() << "built without MuJoCo";
  }
  // Its gears are constraints with a little softness.
  EXPECT_LT(farthest("pendulum", "tests/robots/pendulum/experiments/steps.yaml", "", 0.5, true), 1.0);
  EXPECT_LT(farthest("leg_bench", "robots/mabel/experiments/siso_mLS.yaml", "", 0.3, true), 1.0);
}

TEST(Worlds, WhatIsHiddenShowsByHowStrongItIs) {
  const model::Model model = model_of("pendulum");
  const validation::Experiment experiment =
      experiment_of("pendulum", "tests/robots/pendulum/experiments/multisine.yaml", 1.0);
  const Rig without = rig_of("pendulum", model);
  const auto shown = [&](double level) {
    Rig with = without;
    hide({"coulomb", "drive", {{"level", level}, {"smoothing_speed", 0.1}}}, with);
    return visibility(record(with, experiment, model), without, stated(model));
  };
  EXPECT_NEAR(shown(0.0), 1.0, 1e-6);
  EXPECT_GT(shown(1.6e-4), 1.15);  // what the scoreboard calls visible
  EXPECT_GT(shown(1.6e-4), shown(2e-5));
}

// A stated number that is off by less than what is stated of it explains itself.
TEST(Worlds, AnHonestChangeOfAStatedNumberIsNotVisible) {
  const model::Model model = model_of("pendulum");
  const validation::Experiment experiment =
      experiment_of("pendulum", "tests/robots/pendulum/experiments/multisine.yaml", 1.0);
  const Rig without = rig_of("pendulum", model);
  Rig with = without;
  with.motor("drive")->torque_per_unit *= 1.01;  // stated within 5 %
  EXPECT_LT(visibility(record(with, experiment, model), without, stated(model)), 1.05);
  EXPECT_GT(visibility(record(with, experiment, model), without, {}), 1.5);
}

}  // namespace
}  // namespace plumbline::battery::worlds
