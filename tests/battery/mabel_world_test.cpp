// MABEL's foreign world against the simulator: accelerations in the air and in the ground, energy, and two
// hops.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "simulator/run/run_scenario.h"
#include "tests/battery/worlds/hops.h"
#include "tests/battery/worlds/play.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::battery::worlds {
namespace {

constexpr double kSame = 1.0;  // floors: landings at fixed steps
const std::string kScenario = PLUMBLINE_ROOT "/robots/mabel/scenarios/hopping.yaml";

const run::LoadedScenario& loaded() {
  static const run::LoadedScenario kLoaded = run::read_scenario(kScenario);
  return kLoaded;
}

/// What the rig's coordinates and motors are called in the model.
const std::vector<std::string> kNames{
    "hip_x",           "hip_z",           "torso",    "leg_angle_left", "leg_shape_left",
    "leg_angle_right", "leg_shape_right", "bsp_left", "bsp_right",      "mLA_left",
    "mLS_left",        "mLA_right",       "mLS_right"};

/// Positions and rates by name as a state of the plant, hidden states 0.
class OfPlant {
 public:
  explicit OfPlant(model::Plant& plant) : plant_(plant), map_(kNames.size(), plant.positions()) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    for (Eigen::Index j = 0; j < plant.positions(); ++j) {
      x[plant.positions() + j] = 1.0;
      for (std::size_t i = 0; i < kNames.size(); ++i) {
        map_(static_cast<Eigen::Index>(i), j) = plant.velocity_of(kNames[i], x.data());
      }
      x[plant.positions() + j] = 0.0;
    }
  }
  Eigen::VectorXd state(const Eigen::VectorXd& full, const Eigen::VectorXd& full_rate) const {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
    const auto solver = map_.colPivHouseholderQr();
    x.head(plant_.positions()) = solver.solve(full);
    x.segment(plant_.positions(), plant_.positions()) = solver.solve(full_rate);
    return x;
  }
  Eigen::VectorXd accelerations(const Eigen::VectorXd& xdot) const {
    return map_ * xdot.segment(plant_.positions(), plant_.positions());
  }

 private:
  model::Plant& plant_;
  Eigen::MatrixXd map_;
};

class MabelWorld : public ::testing::Test {
 protected:
  Vector drawn(double reach) {
    Vector v(13);
    for (Eigen::Index i = 0; i < v.size(); ++i) {
      v[i] = reach * std::uniform_real_distribution<double>(-1.0, 1.0)(random_);
    }
    return v;
  }
  /// Motors near where they belong, pulleys out of their stops.
  Vector pose(const Rig& rig) {
    Vector full = drawn(0.5);
    full[7] = std::abs(full[7]);
    full[8] = std::abs(full[8]);
    for (std::size_t m = 0; m < 4; ++m) {
      full[9 + static_cast<Eigen::Index>(m)] += rig.motors[m].at(full);
    }
    return full;
  }

  const model::Model bare_ = loaded().model;
  std::mt19937_64 random_{11};
};

constexpr std::array<const char*, 5> kChanges{
    "gravity_tilt@world:pitch=0.05", "added_mass@shin_left:mass=0.3", "com_shift@torso_link:x=0.01,z=-0.02",
    "ground_friction_error@right:scale=0.8", "ground_damping_error@left:scale=1.3"};

TEST_F(MabelWorld, MovesAsTheSimulatorsInTheAirAndInTheGround) {
  model::Model model = bare_;
  for (const char* hidden : kChanges) {
    model.effects.push_back(validation::parse_effect(hidden, model, model::known_effects()));
  }
  model::Plant plant(model, {});
  Rig rig = rig_of("mabel", bare_);
  for (const char* hidden : kChanges) {
    hide(hidden_from(hidden), rig);
  }
  const Machine machine(rig, {}, Vector::Zero(9));
  const OfPlant named(plant);
  ASSERT_EQ(machine.positions(), plant.positions());
  int in_the_ground = 0;
  for (int i = 0; i < 200; ++i) {
    Vector full = pose(rig);
    // Every other one with its lower foot a millimetre deep.
    const double deepest = std::max(depth_of(rig, rig.grounds[0], full), depth_of(rig, rig.grounds[1], full));
    full[1] += deepest + (i % 2 == 0 ? 1.0 : -1e-3);
    const Vector full_rate = drawn(2.0);
    const Eigen::VectorXd u = drawn(20.0).head(4);
    Eigen::VectorXd xdot(plant.states());
    plant.rate(named.state(full, full_rate).data(), u.data(), xdot.data());
    const Eigen::VectorXd expected = named.accelerations(xdot);
    State rate(machine.states());
    machine.rates(u, machine.state_of(full, full_rate), rate);
    const Eigen::VectorXd found = rate.segment(13, 13);
    for (Eigen::Index k = 0; k < 13; ++k) {
      EXPECT_NEAR(found[k], expected[k], 1e-9 * (1.0 + expected.norm())) << kNames[k] << ", state " << i;
    }
    const double force = ground_force_of(rig, rig.grounds[0], full, full_rate) +
                         ground_force_of(rig, rig.grounds[1], full, full_rate);
    in_the_ground += force > 0.0 ? 1 : 0;
  }
  EXPECT_GE(in_the_ground, 50);
}

// By the simulator's account: Simbody's energy of the links, what rotors, pulleys, cables and springs hold.
TEST_F(MabelWorld, KeepsItsEnergyInFlightWhereNothingDissipates) {
  const auto dissipates = [](const std::string& effect) {
    return effect == "viscous" || effect == "hard_stop" || effect.find("ground") == 0;
  };
  model::Model model = bare_;
  model.effects.erase(
      std::remove_if(model.effects.begin(), model.effects.end(),
                     [&](const model::EffectUse& use) { return dissipates(use.law->declaration().name); }),
      model.effects.end());
  for (model::EffectUse& use : model.effects) {
    const int damping = use.law->parameter_index("damping");
    if (damping >= 0) {
      use.values[static_cast<std::size_t>(damping)].value = 0.0;
    }
  }
  const Rig rig = rig_of("mabel", model);
  const Machine machine(rig, {}, Vector::Zero(9));
  model::Plant plant(model, {});
  const OfPlant named(plant);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(4);
  const auto energies = [&](const State& at) {
    const Eigen::VectorXd x = named.state(machine.positions_of(at), machine.rates_of(at));
    return std::make_pair(plant.energetics(x.data(), still.data()).stored, machine.positions_of(at)[1]);
  };
  State x = machine.state_of(pose(rig), drawn(1.0));
  const auto [stored, height] = energies(x);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(4, 300);
  for (Eigen::Index k = 0; k < none.cols(); ++k) {
    machine.advance(x, none, k, 1e-3);
  }
  const auto [stored_later, lower] = energies(x);
  EXPECT_LT(lower, height - 0.2);  // some 65 kg have fallen: more than 100 J went into motion
  EXPECT_NEAR(stored_later, stored, 1e-5);
}

// The world's hops under the controller, and the simulator under the same commands from the world's motion
// every tenth of a second: flight, landing, a foot that bounces, a stance, the next landing. (From one start
// alone they part: a robot on two points under given commands falls away from wherever it is.)
TEST_F(MabelWorld, WithNothingHiddenItHopsAsTheSimulator) {
  const Rig rig = rig_of("mabel", bare_);
  const Recording world = hop(rig, loaded(), loaded().scenario.start, 1, std::mt19937_64(1));
  model::Plant plant(bare_, {});
  const OfPlant named(plant);
  run::CommandedOptions options;
  options.energy = options.events = false;
  options.integrator.set_tolerance(1e-9);
  ASSERT_EQ(plant.states(), 2 * plant.positions() + 4);  // bristles along and across of two feet
  constexpr Eigen::Index kWindow = 100;                  // samples
  ASSERT_GT(world.motion.positions.cols(), 4 * kWindow);
  for (Eigen::Index first = 0; first + kWindow < world.motion.positions.cols(); first += kWindow) {
    Eigen::VectorXd x = named.state(world.motion.positions.col(first), world.motion.rates.col(first));
    x[2 * plant.positions()] = world.motion.bristles(0, first);
    x[2 * plant.positions() + 2] = world.motion.bristles(1, first);
    const Eigen::MatrixXd commands = world.motion.commands.middleCols(first, kWindow);
    const run::CommandedRun twin =
        run::run_commands(plant, x, commands, world.period, 0.0, {}, nullptr, options);
    double most = 0.0;
    for (Eigen::Index k = 0; k < kWindow; ++k) {
      const Eigen::VectorXd shown = readings_of(rig, world.motion.positions.col(first + k));
      for (std::size_t s = 0; s < rig.sensors.size(); ++s) {
        const int at = bare_.sensor_index(rig.sensors[s].name);
        const double away = std::abs(shown[static_cast<Eigen::Index>(s)] - twin.outputs(at, k));
        most = std::max(most, away / bare_.sensors[static_cast<std::size_t>(at)].floor());
      }
    }
    EXPECT_LT(most, kSame) << "from sample " << first;
    RecordProperty("floors_from_" + std::to_string(first), std::to_string(most));
  }
}

TEST_F(MabelWorld, SaysWhatItCannotPlay) {
  EXPECT_TRUE(can_play(case_of("mabel/ground_friction_error@right/strong")));
  EXPECT_TRUE(can_play(case_of("mabel/none/1")));
  EXPECT_NE(why_not(case_of("mabel/boom@base/strong")).find("flat"), std::string::npos);
  EXPECT_NE(why_not(case_of("mabel/none/1"), true).find("MuJoCo"), std::string::npos);
  for (const Row& row : mabel_rows()) {
    EXPECT_EQ(can_play(case_of("mabel/" + name_of(row) + "/weak")), row.effect != "boom") << row.effect;
  }
}

}  // namespace
}  // namespace plumbline::battery::worlds
