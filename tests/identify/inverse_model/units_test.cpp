// A command or position whose unit is declared wrongly is found; physics that is missing is not taken for it.
#include <cstdlib>

#include "tests/identify/closed_loop/slider.h"
#include "tests/identify/inverse_model/motion.h"
#include "tests/identify/trial/fixture.h"
#include "validation/identify/inverse_model/inverse_model.h"
#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

class CommandUnits : public ScratchFolder {
 protected:
  void SetUp() override {
    ScratchFolder::SetUp();
    carriage = slider::read(folder);
  }
  Trial trial(double position_factor, const Eigen::VectorXd& of_force) const {
    return motion.trial("q", position_factor * motion.q, of_force / slider::kGain);
  }
  model::Model carriage;
  const KnownMotion motion{0.1, 0.5, 0.01, 3.0};
  const Eigen::VectorXd force = slider::kMass * motion.a + slider::kDamping * motion.v;
};

TEST_F(CommandUnits, RightUnitsHaveGainOne) {
  const std::vector<CommandGain> gains = command_gains(carriage, trial(1.0, force));
  ASSERT_EQ(gains.size(), 1U);
  EXPECT_EQ(gains[0].motor, "drive");
  EXPECT_NEAR(gains[0].gain, 1.0, 1e-3);
  EXPECT_NEAR(gains[0].core_gain, 1.0, 1e-2);
  EXPECT_GT(gains[0].core_correlation, 0.999);
  EXPECT_NO_THROW(check_command_units(carriage, trial(1.0, force)));
}

TEST_F(CommandUnits, VoltsTakenForNewtons) {
  carriage.motors[0].command_unit = "N";
  const Trial wrong = trial(1.0, force);
  EXPECT_NEAR(command_gains(carriage, wrong).at(0).gain, slider::kGain, 1e-2);
  const std::string message = input_error([&] { check_command_units(carriage, wrong); });
  for (const char* part :
       {"motion/trial.yaml", "commands.drive.column", "needs 5 times the force of column \"vir\" in V",
        "about 1", "unit of this column is probably wrong"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST_F(CommandUnits, ForceTooBig) {
  EXPECT_NE(
      input_error([&] { check_command_units(carriage, trial(1.0, 1000.0 * force)); }).find("0.001 times"),
      std::string::npos);
}

TEST_F(CommandUnits, PositionsOfAnotherUnit) {
  for (const double factor : {57.29577951308232, 0.017453292519943295, 1000.0, 0.001}) {
    EXPECT_THROW(check_command_units(carriage, trial(factor, force)), InputError) << factor;
  }
}

// Friction ten times as large as all the rest is no wrong unit: the inertia is still there.
TEST_F(CommandUnits, MissingFrictionIsNoWrongUnit) {
  const double level = 10.0 * force.norm() / std::sqrt(static_cast<double>(force.size()));
  const Eigen::VectorXd coulomb = force.array() + level * motion.v.array().sign();
  const std::vector<CommandGain> gains = command_gains(carriage, trial(1.0, coulomb));
  EXPECT_LT(gains.at(0).gain, 0.25);
  EXPECT_NO_THROW(check_command_units(carriage, trial(1.0, coulomb)));
  const Eigen::VectorXd viscous = force + 20.0 * slider::kDamping * motion.v;
  EXPECT_NO_THROW(check_command_units(carriage, trial(1.0, viscous)));
  const Eigen::VectorXd spring = force + 5000.0 * motion.q;
  EXPECT_NO_THROW(check_command_units(carriage, trial(1.0, spring)));
  // With both, the wrong unit is still found.
  EXPECT_THROW(check_command_units(carriage, trial(1.0, 1000.0 * viscous)), InputError);
}

// A rotor behind a gear that is fifty times what was guessed is no wrong unit where the guess says so.
TEST_F(CommandUnits, RotorThatWasGuessedIsNoWrongUnit) {
  const Eigen::VectorXd geared = force + 50.0 * slider::kMass * motion.a;
  EXPECT_THROW(check_command_units(carriage, trial(1.0, geared)), InputError) << "stated as known";
  carriage.motors[0].rotor_inertia.uncertainty = carriage.motors[0].rotor_inertia.value;
  EXPECT_NO_THROW(check_command_units(carriage, trial(1.0, geared)));
}

// What hangs at a light forearm may ask for twenty times its torque: the other joint's column says that the
// unit is right. In a wrong unit no column follows.
TEST_F(CommandUnits, OneColumnSpeaksForItsUnit) {
  const std::string folder_of = PLUMBLINE_ROOT "/tests/robots/double_pendulum/";
  const model::Model arm = model::read_model(folder_of + "model.yaml", effects::Catalogue::all());
  const Trial right = twin(arm, read_experiment(folder_of + "swing.yaml", arm), {});
  ASSERT_EQ(right.commands.size(), 2U);
  EXPECT_NO_THROW(check_command_units(arm, right));
  Trial loaded = right;
  loaded.commands[1].values *= 20.0;
  ASSERT_TRUE(command_gains(arm, loaded).at(1).implausible());
  EXPECT_NO_THROW(check_command_units(arm, loaded));
  Trial wrong = right;
  for (Command& command : wrong.commands) {
    command.values *= 1000.0;
  }
  EXPECT_THROW(check_command_units(arm, wrong), InputError);
}

TEST_F(CommandUnits, TwinsOfThePendulum) {
  const model::Model pendulum =
      model::read_model(PLUMBLINE_ROOT "/tests/robots/pendulum/model.yaml", effects::Catalogue::all());
  for (const char* name : {"multisine", "chirp", "steps"}) {
    const Experiment experiment = read_experiment(
        std::string(PLUMBLINE_ROOT "/tests/robots/pendulum/experiments/") + name + ".yaml", pendulum);
    const Trial right = twin(pendulum, experiment, {});
    EXPECT_NO_THROW(check_command_units(pendulum, right)) << name;
    Trial wrong = right;
    wrong.commands[0].values *= 1000.0;  // mA taken for A
    EXPECT_THROW(check_command_units(pendulum, wrong), InputError) << name;
  }
}

class EmpsUnits : public testing::Test {
 protected:
  void SetUp() override {
    if (std::getenv("PLUMBLINE_EMPS_DATA") == nullptr) {
      GTEST_SKIP() << "PLUMBLINE_EMPS_DATA names no folder: the measured EMPS data are not here";
    }
  }
  model::Model emps = model::read_model(PLUMBLINE_ROOT "/robots/emps/emps.yaml", effects::Catalogue::all());
};

TEST_F(EmpsUnits, RightAndWrong) {
  for (const char* name : {"identification", "pulses"}) {
    const Trial trial = read_trial(std::string(PLUMBLINE_ROOT "/validation/trials/emps/") + name, emps);
    EXPECT_NO_THROW(check_command_units(emps, trial)) << name;
    model::Model wrong = emps;
    wrong.motors[0].command_unit = "N";
    const std::string message = input_error([&] { check_command_units(wrong, trial); });
    EXPECT_NEAR(command_gains(wrong, trial).at(0).factor(), 35.15, 0.7) << name;  // N/V, to 2 %
    EXPECT_NE(message.find("column \"vir\" in V"), std::string::npos) << message;
    Trial millimetres = trial;
    millimetres.measured[0].values *= 1e-3;
    EXPECT_THROW(check_command_units(emps, millimetres), InputError) << name;
  }
}

// The benchmark's own parameters and its definition of the error: 4.08 % and 5.98 % published.
TEST_F(EmpsUnits, PublishedInverseModelErrors) {
  for (const char* effect :
       {"coulomb@carriage:level=20.3935,smoothing_speed=1e-5", "torque_bias@drive:bias=3.1648"}) {
    emps.effects.push_back(parse_effect(effect, emps, effects::Catalogue::all()));
  }
  const auto error = [&](const char* name) {
    const Trial trial = read_trial(std::string(PLUMBLINE_ROOT "/validation/trials/emps/") + name, emps);
    return inverse_model(emps, trial, {}).motors.at(0).error_percent();
  };
  // They also decimate, with another filter; the pulses' edges feel that.
  EXPECT_NEAR(error("identification"), 4.08, 0.2);
  EXPECT_NEAR(error("pulses"), 5.98, 0.5);
}

}  // namespace
}  // namespace plumbline::validation
