// What no catalogue has, as the foreign worlds play it: against limits, an account of energy and another
// program of the same physics.
#include "tests/battery/worlds/outside.h"

#include <gtest/gtest.h>

#include <cmath>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "tests/battery/worlds/recorder.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::battery::worlds {
namespace {

std::string in_root(const std::string& file) { return std::string(PLUMBLINE_ROOT) + "/" + file; }

const std::string kPendulum = "tests/robots/pendulum/";

model::Model pendulum_model() {
  return model::read_model(in_root(kPendulum + "model.yaml"), model::known_effects());
}

validation::Experiment steps(double duration) {
  validation::Experiment e =
      validation::read_experiment(in_root(kPendulum + "experiments/steps.yaml"), pendulum_model());
  const auto samples = static_cast<Eigen::Index>(std::lround(duration / e.period));
  e.time.conservativeResize(samples);
  e.duration = duration;
  e.commands.front().values.conservativeResize(samples);
  return e;
}

Rig pendulum_with(const std::string& hidden) {
  Rig rig = rig_of("pendulum", pendulum_model());
  hide(hidden_from(hidden), rig);
  return rig;
}

/// The rig alone, without motor and friction, let go at an angle.
Motion dropped(Rig rig, double angle, Eigen::Index samples) {
  rig.motors.front().inertia = 0.0;
  rig.effects.erase(rig.effects.begin());  // the drive's friction
  Vector start(1);
  start << angle;
  const Machine machine(rig, {}, start);
  const Vector rest = Vector::Zero(1);
  return machine.run(machine.start_state(rest), 0, samples, 1e-3,
                     [](Eigen::Index, const Eigen::VectorXd&, Vector& u) { u.setZero(); });
}

// A load that does not creep is a payload, which the simulator knows.
TEST(Outside, LoadThatStaysIsThePayloadOfTheSimulatorsTwin) {
  const model::Model model = pendulum_model();
  const validation::Experiment experiment = steps(0.6);
  model::Model with = model;
  with.effects.push_back(
      validation::parse_effect("payload@arm:mass=0.2,x=0,y=0,z=-0.25", model, model::known_effects()));
  validation::TwinOptions options;
  options.quantise = false;
  const validation::Trial twin = validation::twin(with, experiment, options);
  const Rig rig = pendulum_with("creeping_load@shoulder:mass=0.2,from=0.25,mobility=0");
  const Recording recording = record(rig, experiment, model);
  for (Eigen::Index k = 0; k < twin.samples(); ++k) {
    const Eigen::VectorXd shown = readings_at(rig, recording.motion, k, recording.period);
    for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
      EXPECT_NEAR(shown[static_cast<Eigen::Index>(s)], twin.measured[s].values[k],
                  0.1 * model.find_sensor(rig.sensors[s].name)->floor());
    }
  }
}

// What a load in grease loses is the square of its speed over its mobility; the distance is followed by
// Euler's steps of a millisecond, which is good for a thousandth of the loss.
TEST(Outside, CreepingLoadLosesWhatItsGreaseTakes) {
  Rig rig = pendulum_with("creeping_load@shoulder:mass=0.3,from=0.1,mobility=0.01");
  const Link& arm = rig.bodies.front();
  const Motion motion = dropped(rig, 1.2, 1001);
  double r = 0.1;
  double lost = 0.0;
  const auto energy = [&](Eigen::Index k) {
    const double x = motion.positions(0, k);
    const double v = motion.rates(0, k);
    return 0.5 * (arm.about_pivot() + 0.3 * r * r) * v * v -
           rig.gravity * std::cos(x) * (arm.mass * arm.along + 0.3 * r);
  };
  const double before = energy(0);
  for (Eigen::Index k = 0; k < 1000; ++k) {
    const double v = 0.5 * (motion.rates(0, k) + motion.rates(0, k + 1));
    const double x = 0.5 * (motion.positions(0, k) + motion.positions(0, k + 1));
    const double creeps = 0.01 * (rig.gravity * std::cos(x) + r * v * v);
    lost += 0.3 * creeps * creeps / 0.01 * 1e-3;
    r += creeps * 1e-3;
  }
  EXPECT_GT(lost, 0.1);
  EXPECT_NEAR(before - energy(1000), lost, 2e-3 * lost);
}

// A mounting that has tilted is one that was always tilted so.
TEST(Outside, MountingHasTheTiltThatItHasComeTo) {
  const model::Model model =
      model::read_model(in_root("robots/mabel/leg_bench.yaml"), model::known_effects());
  Rig tilting = rig_of("leg_bench", model);
  hide(hidden_from("tilting_mount@world:rate=0.01"), tilting);
  Rig tilted = rig_of("leg_bench", model);
  tilted.tilt = 0.3;
  const Vector start = Vector::Zero(2);
  State x(5);
  x << 0.4, -0.2, 1.5, -2.0, 0.3;
  State rate(5);
  Machine(tilting, {}, start).rates(Vector::Zero(2), x, rate);
  State expected(4);
  Machine(tilted, {}, start).rates(Vector::Zero(2), x.head(4), expected);
  EXPECT_NEAR((rate.head(4) - expected).norm(), 0.0, 1e-9 * expected.norm());
  EXPECT_DOUBLE_EQ(rate[4], 0.01);
}

TEST(Outside, AmplifierTurnsRoundInItsTime) {
  const Hidden slow = hidden_from("slow_reversal@drive:time=0.002");
  double sense_rate = 0.0;
  EXPECT_DOUBLE_EQ(turned_round(slow, 3.0, 1.0, sense_rate), 3.0);
  EXPECT_DOUBLE_EQ(sense_rate, 0.0);
  EXPECT_DOUBLE_EQ(turned_round(slow, -3.0, 1.0, sense_rate), 3.0);
  EXPECT_DOUBLE_EQ(sense_rate, -1000.0);
  EXPECT_DOUBLE_EQ(turned_round(slow, 0.0, 1.0, sense_rate), 0.0);
  EXPECT_DOUBLE_EQ(sense_rate, 0.0);
}

// A step from -u to u gives what 2 u of a lag of that time would: motion is the lag's.
TEST(Outside, ReversedStepMovesAsBehindALag) {
  validation::Experiment experiment = steps(0.1);
  Eigen::VectorXd& u = experiment.commands.front().values;
  u.head(50).setConstant(-0.2);
  u.tail(50).setConstant(0.2);
  const model::Model model = pendulum_model();
  const Motion slow = record(pendulum_with("slow_reversal@drive:time=0.004"), experiment, model).motion;
  const Motion lag =
      record(pendulum_with("actuator_lag@drive:time_constant=0.004"), experiment, model).motion;
  const Motion none = record(rig_of("pendulum", model), experiment, model).motion;
  EXPECT_LT((slow.positions - lag.positions).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GT((slow.positions - none.positions).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(Outside, FieldIsWholeInTheMiddle) {
  const Hidden weak = hidden_from("weakening_ends@drive:loss=0.2,centre=1,reach=10");
  EXPECT_DOUBLE_EQ(weakened(weak, 2.0, 1.0), 2.0);
  EXPECT_DOUBLE_EQ(weakened(weak, 2.0, 11.0), 1.6);
  EXPECT_DOUBLE_EQ(weakened(weak, 2.0, -4.0), 1.9);
  EXPECT_DOUBLE_EQ(delivered(weak, 2.0, 11.0, 5.0), 1.6);
}

TEST(Outside, HeldReadingsAreOldAsOftenAsStated) {
  constexpr double kShare = 0.1;
  int holds = 0;
  for (std::int64_t k = 2; k < 100000; ++k) {
    const int back = held_for(kShare, k);
    holds += back == 2 ? 1 : 0;
    // The one before shows the same reading, unless it is the second of an earlier hold.
    EXPECT_TRUE(back != 2 || held_for(kShare, k - 1) >= 1) << k;
  }
  EXPECT_NEAR(holds / 1e5, kShare, 4.0 * std::sqrt(kShare / 1e5));
  EXPECT_EQ(held_for(0.9, 0), 0);
}

TEST(Outside, HeldReadingIsTheOneOfTheSampleBefore) {
  const Rig rig = pendulum_with("held_reading@shoulder:share=0.2");
  const Recording recording = record(rig, steps(0.5), pendulum_model());
  for (Eigen::Index k = 0; k < 500; ++k) {
    const Eigen::Index then = k - held_for(0.2, k);
    EXPECT_NEAR(readings_at(rig, recording.motion, k, recording.period)[1],
                recording.motion.positions(0, then), 1e-12);
  }
}

TEST(Outside, HeavyBitAddsItsErrorInEveryOtherCell) {
  const Rig rig = pendulum_with("heavy_bit@shoulder:error=0.01,step=0.1");
  for (const auto& [angle, added] :
       {std::pair{0.05, 0.0}, {0.15, 0.01}, {0.25, 0.0}, {-0.05, 0.01}, {-0.15, 0.0}}) {
    Vector full(2);
    full << angle, 50.0 * angle;
    EXPECT_NEAR(readings_of(rig, full)[1], angle + added, 1e-12);
  }
}

}  // namespace
}  // namespace plumbline::battery::worlds
