// Files that a user can get wrong, through the real program: exit status 2, one line, nothing written.
#include "tests/cli/bad_input.h"

#include <cstdint>
#include <cstring>
#include <functional>

namespace plumbline::test {
namespace {

constexpr const char* kMotorless = R"(plumbline: model/1
robot: swing
skeleton: pendulum_drive.urdf
coordinates:
  shoulder: {of: {shoulder: 1}}
effects:
  - {effect: battery, at: world}
sensors:
  shoulder: {measures: shoulder, counts_per_turn: 16384, gear: 1, noise: {value: 0, unit: rad, assumed: none}, source: s}
)";

TEST_P(BadInputs, AreRefusedInOneLineAndNothingIsWritten) {
  const BadInput& bad = GetParam();
  make(bad.edits);
  const auto before = snapshot();
  const Outcome outcome = plumbline(bad.arguments);
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("plumbline: ", 0), 0U) << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.err.back(), '\n');
  for (const std::string& part : bad.message) {
    EXPECT_THAT(outcome.err, testing::HasSubstr(part));
  }
  EXPECT_THAT(changed_since(before), testing::IsEmpty());
}

/// A text with the bytes of numbers behind it, as in binary files.
template <typename Number>
void append(std::string& bytes, std::initializer_list<Number> values) {
  for (const Number value : values) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
}

/// A MATLAB file of version 4 with one vector of 30 numbers: MATLAB's "MAT-File Format", Level 4.
std::string mat_version_4() {
  std::string bytes;
  append<std::int32_t>(bytes, {0, 30, 1, 0, 2});
  bytes += std::string("t\0", 2);
  for (int i = 0; i < 30; ++i) {
    append<double>(bytes, {0.002 * i});
  }
  return bytes;
}

std::vector<Edit> data_from(const std::string& file, const std::string& content) {
  return {{"trials/steps/" + file, "", content}, {kTrial, "data: data.csv", "data: " + file}};
}

INSTANTIATE_TEST_SUITE_P(
    Columns, BadInputs,
    testing::Values(
        BadInput{"missing",
                 {{kTrial, "q_shoulder", "q_elbow"}},
                 kCompare,
                 {"trial.yaml:", "q_elbow", "data.csv", "expected", "found"}},
        BadInput{"misspelt",
                 {{kData, "q_drive", "q_dirve"}},
                 kCompare,
                 {"q_drive", "found", "expected", "did you mean", "q_dirve"}},
        BadInput{"duplicate",
                 {{kData, "q_shoulder", "q_drive"}},
                 kCompare,
                 {"data.csv:1: q_drive: found this column name twice, expected"}},
        BadInput{"unit_unknown",
                 {{kData, "q_drive [rad]", "q_drive [radd]"}},
                 kCompare,
                 {"measured.drive.column: found column \"q_drive\"", "did you mean"}},
        BadInput{"unit_of_another_dimension_in_the_data",
                 {{kData, "q_drive [rad]", "q_drive [V]"}},
                 kCompare,
                 {"q_drive", "found", "V", "expected", "rad"}},
        BadInput{"unit_of_another_dimension_in_the_trial",
                 {{kTrial, "q_drive, unit: rad", "q_drive, unit: kg"}},
                 kCompare,
                 {"trial.yaml:", "measured.drive.unit: found", "kg", "expected", "rad"}},
        BadInput{"not_a_number",
                 {{kData, "\n0.1,0.4,", "\n0.1,nan,"}},
                 kCompare,
                 {"data.csv:52: u_drive: found \"nan\", expected finite numbers"}},
        BadInput{"infinite",
                 {{kData, "\n0.1,0.4,", "\n0.1,inf,"}},
                 kCompare,
                 {"data.csv:52: u_drive: found \"inf\", expected finite numbers"}},
        BadInput{"text",
                 {{kData, "\n0.1,0.4,", "\n0.1,x,"}},
                 kCompare,
                 {"data.csv:52: u_drive: found \"x\", expected finite numbers"}},
        BadInput{"ragged",
                 {{kData, "\n0.1,0.4,", "\n0.1,0.4,0,"}},
                 kCompare,
                 {"data.csv:52: found 5 fields, expected 4"}},
        BadInput{"empty_file", {{kData, "", ""}}, kCompare, {"data.csv:1: found an empty file, expected"}},
        BadInput{"no_rows",
                 {{kData, "", std::string(kHead) + "\n"}},
                 kCompare,
                 {"data.csv", "no rows", "expected"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Matlab, BadInputs,
    testing::Values(BadInput{"garbage",
                             data_from("data.mat", std::string(4000, 'g')),
                             kCompare,
                             {"trials/steps/data.mat: found", "expected a MATLAB file, version 5 or 7.3"}},
                    BadInput{"short_file",
                             data_from("data.mat", "MATLAB 5.0"),
                             kCompare,
                             {"trials/steps/data.mat: found", "expected a MATLAB file, version 5 or 7.3"}},
                    BadInput{"version_4",
                             data_from("data.mat", mat_version_4()),
                             kCompare,
                             {"trials/steps/data.mat: found", "expected a MATLAB file, version 5 or 7.3"}},
                    BadInput{"another_kind",
                             data_from("data.txt", "1 2 3"),
                             kCompare,
                             {"found column \"t\", expected a column of", "data.txt"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Trials, BadInputs,
    testing::Values(
        BadInput{"no_such_trial", {}, {"compare", "trials/stops"}, {"trials/stops", "found", "expected"}},
        BadInput{"no_such_model",
                 {},
                 {"compare", "trials/steps", "--model", "robot/modle.yaml"},
                 {"robot/modle.yaml: found nothing at this path, expected a file"}},
        BadInput{"shorter_than_a_window",
                 {},
                 {"compare", "trials/steps", "--window", "3", "--json", "out.json"},
                 {"trials/steps/trial.yaml: data: found 1000 samples, expected at least one window of 1500"}},
        BadInput{"far_shorter_than_a_window",
                 {},
                 {"compare", "trials/steps", "--window", "1e30"},
                 {"found 1000 samples, expected at least one window of ", "e+32 samples"}},
        BadInput{
            "a_window_of_no_sample",
            {},
            {"compare", "trials/steps", "--window", "1e-9"},
            {"trials/steps/trial.yaml: data: found windows of 0 samples, expected windows of 8 or more"}},
        BadInput{
            "no_train_trial",
            {},
            {"fit", "trials/swing", "--free", "*", "--json", "out.json"},
            {"trials/swing/trial.yaml: role: found held-out, expected at least one trial with role: train"}},
        BadInput{"nothing_to_diagnose_from",
                 {},
                 {"diagnose", "trials/swing", "--json", "out.json"},
                 {"found no trial with role: train"}},
        BadInput{"same_file_held_out",
                 {{"trials/swing/trial.yaml", "data: data.csv", "data: ../steps/data.csv"}},
                 {"compare", "trials/steps", "trials/swing", "--json", "out.json"},
                 {"trials/swing/trial.yaml: data: found the data file of the train trial "
                  "trials/steps/trial.yaml"}},
        BadInput{"cut_off",
                 {{kTrial, "measured:", "measured: {"}},
                 kCompare,
                 {"trials/steps/trial.yaml:", "found", "expected"}},
        BadInput{"unknown_key",
                 {{kTrial, "role:", "rule:"}},
                 kCompare,
                 {"trial.yaml:", "rule: found", "expected", "role"}},
        BadInput{"unknown_role",
                 {{kTrial, "role: train", "role: trained"}},
                 kCompare,
                 {"role: found \"trained\", expected train, held-out or test"}},
        BadInput{"unknown_sensor",
                 {{kTrial, "  shoulder:", "  sholder:"}},
                 kCompare,
                 {"measured.sholder: found", "expected", "did you mean shoulder?"}},
        BadInput{"unknown_motor",
                 {{kTrial, "  drive: {column: u_drive", "  driv: {column: u_drive"}},
                 kCompare,
                 {"driv: found", "expected", "did you mean drive?"}},
        BadInput{"newer_version",
                 {{kTrial, "trial/1", "trial/9"}},
                 kCompare,
                 {"trial.yaml:1: plumbline: found \"trial/9\", expected", "trial/1"}},
        BadInput{
            "neither_model_nor_trial",
            {},
            {"check", "experiments/steps.yaml"},
            {"experiments/steps.yaml:1: plumbline: found \"experiment/1\", expected model/1 or trial/1"}},
        BadInput{"everything_locked",
                 {{kTrial, "commands:", "locked: {shoulder: {value: 0, unit: rad}}\ncommands:"}},
                 {"check", "trials/steps", "--json", "out.json"},
                 {"robot/model.yaml: found no coordinate left to move, expected"}},
        BadInput{"no_controller",
                 {},
                 {"simulate", "trials/steps", "--closed-loop", "--out", "trace.csv"},
                 {"trials/steps/trial.yaml: controllers: found none, expected"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Models, BadInputs,
    testing::Values(
        BadInput{"cut_off",
                 {{kModel, "ratios:", "ratios: {"}},
                 kCheckModel,
                 {"robot/model.yaml:", "found", "expected"}},
        BadInput{"empty", {{kModel, "", ""}}, kCheckModel, {"robot/model.yaml", "found", "expected"}},
        BadInput{"ratio_of_zero",
                 {{kModel, "value: 50", "value: 0"}},
                 kCheckModel,
                 {"robot/model.yaml:18: ratios.shoulder", "found", "0", "expected"}},
        BadInput{"negative_inertia",
                 {{kModel, "value: 3.3e-5", "value: -3.3e-5"}},
                 kCheckModel,
                 {"robot/model.yaml:14: motors.drive.rotor_inertia", "found", "expected"}},
        BadInput{"unit_of_another_dimension",
                 {{kModel, "unit: N m/A", "unit: N m"}},
                 kCheckModel,
                 {"robot/model.yaml:15: motors.drive.torque_constant", "found", "N m", "expected", "N m/A"}},
        BadInput{"unit_missing",
                 {{kModel, "value: 3.3e-5, unit: kg m^2,", "value: 3.3e-5,"}},
                 kCheckModel,
                 {"robot/model.yaml:14: motors.drive.rotor_inertia", "found", "unit", "expected"}},
        BadInput{"source_missing",
                 {{kModel, ", source: \"gearbox data sheet\"", ""}},
                 kCheckModel,
                 {"robot/model.yaml:18", "found", "source", "expected"}},
        BadInput{"unknown_effect",
                 {{kModel, "effect: viscous", "effect: viscus"}},
                 kCheckModel,
                 {"robot/model.yaml:21", "found \"viscus\", expected an effect of the catalogue",
                  "did you mean viscous"}},
        BadInput{"unknown_place",
                 {{kModel, "at: drive", "at: driv"}},
                 kCheckModel,
                 {"robot/model.yaml:22", "found \"driv\", expected", "did you mean drive?"}},
        BadInput{"unknown_parameter",
                 {{kModel, "damping:", "dampng:"}},
                 kCheckModel,
                 {"robot/model.yaml:24", "found an unknown parameter, expected", "did you mean damping?"}},
        BadInput{"drive_law_without_a_motor",
                 {{kModel, "effect: viscous\n    at: drive", "effect: voltage_limit\n    at: shoulder"}},
                 kCheckModel,
                 {"robot/model.yaml:22", "found \"shoulder\", expected", "drive"}},
        BadInput{
            "winding_that_contradicts_itself",
            {{kModel, "command_unit: A", "command_unit: V"},
             {kModel,
              "torque_constant: {value: 0.0525, unit: N m/A, uncertainty: 5 %, source: \"motor data sheet\"}",
              "winding: {resistance: {value: 1, unit: ohm, source: s}, torque_constant: {value: 0.0525, "
              "unit: "
              "N m/A, source: s}, back_emf: {value: 5.5, unit: V s/rad, source: s}}"}},
            kCheckModel,
            {"robot/model.yaml:15",
             "a back EMF of 5.5 V s/rad that contradicts the torque constant of 0.0525"}},
        BadInput{
            "below_absolute_zero",
            {{kModel, "sensors:",
              "  - {effect: thermal_motor, at: drive, values: {ambient: {value: -1, unit: K, source: s}}}\n\n"
              "sensors:"}},
            kCheckModel,
            {"robot/model.yaml:", "found -1 (SI), expected a value from 0"}},
        BadInput{"battery_without_a_motor",
                 {{kModel, "", kMotorless}},
                 kCheckModel,
                 {"robot/model.yaml:7", "found \"battery\" of a robot without a motor"}},
        BadInput{"unknown_joint",
                 {{kModel, "of: {shoulder: 1}", "of: {sholder: 1}"}},
                 kCheckModel,
                 {"robot/model.yaml:9", "found", "expected", "did you mean shoulder?"}},
        BadInput{"contradictory_ratios",
                 {{kModel, "effects:",
                   "  again: {motor: drive, ratio: {value: 30, unit: \"1\", source: test}}\n\neffects:"},
                  {kModel, "  shoulder: {of: {shoulder: 1}}",
                   "  shoulder: {of: {shoulder: 1}}\n  again: {of: {shoulder: 1}}"}},
                 kCheckModel,
                 {"robot/model.yaml:21: ratios.again: found ratios that contradict each other", "expected"}},
        BadInput{"singular_mass_matrix",
                 {{"robot/pendulum_drive.urdf", "</robot>",
                   "<link name=\"dust\"><inertial><mass value=\"1e-3\"/><inertia ixx=\"1e-15\" ixy=\"0\" "
                   "ixz=\"0\" "
                   "iyy=\"1e-15\" iyz=\"0\" izz=\"1e-15\"/></inertial></link>\n"
                   "<joint name=\"wrist\" type=\"revolute\"><parent link=\"arm\"/><child "
                   "link=\"dust\"/><axis xyz=\"0 1 "
                   "0\"/><limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/></joint>\n</robot>"},
                  {kModel, "  shoulder: {of: {shoulder: 1}}",
                   "  shoulder: {of: {shoulder: 1}}\n  wrist: {of: {wrist: 1}}"}},
                 kCheckModel,
                 {"robot/model.yaml: found a singular mass matrix", "expected"}},
        BadInput{"no_skeleton",
                 {{kModel, "pendulum_drive.urdf", "pendulum_driv.urdf"}},
                 kCheckModel,
                 {"robot/model.yaml:3: skeleton: found \"pendulum_driv.urdf\"", "expected"}},
        BadInput{"broken_skeleton",
                 {{"robot/pendulum_drive.urdf", "</link>", "</lnk>"}},
                 kCheckModel,
                 {"pendulum_drive.urdf", "found", "expected"}}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    Names, BadInputs,
    testing::Values(
        BadInput{"effects",
                 {},
                 {"effects", "cable_strech", "--json", "out.json"},
                 {"found \"cable_strech\", expected an effect", "did you mean cable_stretch?"}},
        BadInput{"without",
                 {},
                 {"diagnose", "trials/steps", "--without", "culomb", "--json", "out.json"},
                 {"culomb", "did you mean coulomb"}},
        BadInput{"add_effect",
                 {},
                 {"add", "culomb", "--at", "drive", "--model", kModel, "--out", "new.yaml"},
                 {"culomb", "did you mean coulomb"}},
        BadInput{"add_place",
                 {},
                 {"add", "coulomb", "--at", "driv", "--model", kModel, "--out", "new.yaml"},
                 {"found place \"driv\", expected the name of a coordinate or motor; did you mean drive?"}},
        BadInput{
            "add_parameter",
            {},
            {"add", "coulomb", "--at", "drive", "--set", "levl=1", "--model", kModel, "--out", "new.yaml"},
            {"levl", "did you mean level?"}},
        BadInput{
            "add_out_of_bounds",
            {},
            {"add", "coulomb", "--at", "drive", "--set", "level=-1", "--model", kModel, "--out", "new.yaml"},
            {"found level = -1, expected 0 to inf"}},
        BadInput{"add_text",
                 {},
                 {"add", "coulomb", "--at", "drive", "--set", "level=much", "--model", kModel, "--out",
                  "new.yaml"},
                 {"found 'much', expected a number"}},
        BadInput{"add_twice",
                 {},
                 {"add", "viscous", "--at", "drive", "--model", kModel, "--out", "new.yaml"},
                 {"new.yaml:", "found viscous at drive twice, expected"}},
        BadInput{"twin_effect",
                 {},
                 {"twin", "--model", kModel, "--with", "culomb@drive:level=1", "--experiment",
                  "experiments/steps.yaml", "--out", "new"},
                 {"culomb", "did you mean coulomb"}},
        BadInput{"free_nothing",
                 {},
                 {"fit", "trials/steps", "--free", "coulomb*", "--out", "new.yaml"},
                 {"--free: found \"coulomb*\", which matches nothing", "viscous@drive:damping"}},
        BadInput{
            "free_at_null",
            {{"new.yaml", "",
              "plumbline: model/1\nbase: robot/model.yaml\neffects:\n  - {effect: actuator_lag, at: "
              "drive}\n"}},
            {"fit", "trials/steps", "--model", "new.yaml", "--free", "actuator_lag*", "--json", "out.json"},
            {"new.yaml:4: actuator_lag@drive:time_constant: found an effect at its null values, expected"}}),
    name_of);

}  // namespace
}  // namespace plumbline::test
