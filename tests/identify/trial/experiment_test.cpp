#include "validation/identify/twin/experiment.h"

#include <algorithm>
#include <ostream>

#include "tests/identify/trial/fixture.h"

namespace plumbline::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;

class ReadExperiment : public ScratchFolder {
 protected:
  Experiment read(const std::string& text) {
    write_file(folder / "experiment.yaml", text);
    return read_experiment((folder / "experiment.yaml").string(), robot);
  }
};

TEST_F(ReadExperiment, CommandsAreSampledInSi) {
  const Experiment experiment = read(good_experiment());
  EXPECT_EQ(experiment.title, "A test");
  EXPECT_EQ(experiment.role, Role::held_out);
  EXPECT_DOUBLE_EQ(experiment.period, 0.01);
  EXPECT_DOUBLE_EQ(experiment.duration, 2.0);
  ASSERT_EQ(experiment.time.size(), 200);
  EXPECT_NEAR(experiment.time[199], 1.99, 1e-12);
  ASSERT_EQ(experiment.start.size(), 2U);
  EXPECT_NEAR(experiment.start[0].position, 12 * kPi / 180, 1e-12);
  EXPECT_NEAR(experiment.start[1].position, 0.004, 1e-12);
  EXPECT_EQ(experiment.locked, std::vector<std::string>{"mLeg"});
  ASSERT_EQ(experiment.commands.size(), 2U);
  const Command& leg = experiment.commands[0];
  EXPECT_EQ(leg.motor, "mLeg");
  EXPECT_EQ(leg.column, "u_mLeg");
  EXPECT_EQ(leg.unit, "N m");
  EXPECT_NEAR(leg.values[25], 1.0 + 0.1 + 25.0 / 199, 1e-9);  // crest of 1 Hz
  EXPECT_NEAR(leg.values[106], 2 * std::sin(2 * kPi * 4 * 0.06) + 0.1 + 106.0 / 199, 1e-9);
  const Command& drive = experiment.commands[1];
  EXPECT_NEAR(drive.values[0], 5.0, 1e-7);
  EXPECT_NEAR(drive.values[50], 5.25, 1e-7);
  EXPECT_NEAR(drive.values[100], 6.25, 1e-7);
  EXPECT_NEAR(drive.values[102], 5 * std::cos(2 * kPi * 2 * 0.02) + 0.25, 1e-7);
}

constexpr const char* kController = R"(controllers:
  - kind: cascade_pd
    motor: drive
    sensor: place
    position_gain: {value: 40, unit: 1/s, assumed: test}
    velocity_gain: {value: 0.25, unit: V s/mm, assumed: test}
    reference:
      - {kind: steps, times: [1 s], levels: [30], unit: mm}
)";

TEST_F(ReadExperiment, AControllerFollowsItsReferenceAndAddsWhatIsCommanded) {
  const Experiment experiment = read(good_experiment() + kController);
  ASSERT_EQ(experiment.controllers.size(), 1U);
  const Controller& one = experiment.controllers[0];
  EXPECT_NEAR(one.velocity_gain, 250, 1e-9);
  EXPECT_NEAR(one.reference[99], 0.0, 1e-12);
  EXPECT_NEAR(one.reference[100], 0.03, 1e-12);
  EXPECT_EQ(one.disturbance, experiment.commands[1].values);
}

TEST_F(ReadExperiment, AControlledMotorNeedsNoCommandOfItsOwn) {
  const std::string text = good_experiment();
  const Experiment experiment = read(text.substr(0, text.find("commands:")) + kController);
  ASSERT_EQ(experiment.commands.size(), 1U);
  EXPECT_EQ(experiment.commands[0].motor, "drive");
  EXPECT_EQ(experiment.controllers[0].disturbance.size(), 0);
}

TEST_F(ReadExperiment, ABadControllerIsRefused) {
  const std::string two = std::string(kController) + std::string(kController).substr(13);
  for (const auto& [text, part] :
       {std::pair<std::string, const char*>{replaced(kController, "unit: mm}", "unit: V}"), "\"V\""},
        {replaced(kController, "sensor: place", "sensor: plase"), "mean place?"},
        {two, "a second controller of motor drive"}}) {
    const std::string message = input_error([&, &bad = text] { read(good_experiment() + bad); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

struct BadExperimentInput {
  const char* name;
  const char* what;
  const char* by;
  std::vector<const char*> message;
};
void PrintTo(const BadExperimentInput& bad, std::ostream* out) { *out << bad.name; }

class BadExperiment : public ReadExperiment, public testing::WithParamInterface<BadExperimentInput> {};

TEST_P(BadExperiment, IsRefusedInOneClearLine) {
  const BadExperimentInput& bad = GetParam();
  const std::string message = input_error([&] { read(replaced(good_experiment(), bad.what, bad.by)); });
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  EXPECT_NE(message.find("experiment.yaml"), std::string::npos) << message;
  for (const char* part : bad.message) {
    EXPECT_NE(message.find(part), std::string::npos) << "no `" << part << "` in: " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Experiment, BadExperiment,
    testing::Values(
        BadExperimentInput{"version", "experiment/1", "trial/1", {":1: plumbline", "experiment/1"}},
        BadExperimentInput{"unknown_key", "locked:", "lokced:", {":7: lokced", "did you mean locked?"}},
        BadExperimentInput{"role", "held-out", "other", {":3: role", "\"other\"", "train, held-out or test"}},
        BadExperimentInput{
            "duration_unit", "2, unit: s", "2, unit: m", {":4: duration.unit", "\"m\"", "\"s\""}},
        BadExperimentInput{"duration_zero", "2, unit: s", "0, unit: s", {":4: duration", "above zero"}},
        BadExperimentInput{"too_short", "2, unit: s", "0.1, unit: s", {":4: duration", "10 samples", "20"}},
        BadExperimentInput{"uneven", "2, unit: s", "2.004, unit: s", {":4: duration", "whole number"}},
        BadExperimentInput{
            "start_of_motor", "carriage: {value", "drive: {value", {":6: start.drive", "coordinates"}},
        BadExperimentInput{"start_unknown", "carriage: {value", "cariage: {value", {"mean carriage?"}},
        BadExperimentInput{"start_unit", "unit: mm", "unit: deg", {":6: start.carriage.unit", "\"m\""}},
        BadExperimentInput{"locked_unknown", "[mLeg]", "[mLag]", {":7: locked", "\"mLag\"", "mLeg"}},
        BadExperimentInput{"locked_twice", "[mLeg]", "[mLeg, mLeg]", {":7: locked.2", "a second time"}},
        BadExperimentInput{"motor_unknown", "  drive:", "  driver:", {":13: commands.driver", "mean drive?"}},
        BadExperimentInput{"kind_unknown",
                           "kind: ramp",
                           "kind: rampe",
                           {":12: commands.mLeg.3.kind", "\"rampe\"", "mean ramp"}},
        BadExperimentInput{
            "shape_key", "last_amplitude", "end_amplitude", {":10", "unknown key", "amplitude"}},
        BadExperimentInput{
            "unit_wrong", "unit: V}", "unit: A}", {":14: commands.drive.1.unit", "\"A\"", "\"V\"", "drive"}},
        BadExperimentInput{
            "unit_missing", "phases: [90 deg], unit: V}", "phases: [90 deg]}", {":14", "no \"unit\""}},
        BadExperimentInput{
            "frequency_without_unit", "[2 Hz]", "[2]", {":14: commands.drive.1.frequencies.1", "0.5 Hz"}},
        BadExperimentInput{"frequency_in_seconds",
                           "from: 1 Hz",
                           "from: 1 s",
                           {":10: commands.mLeg.1.from", "\"s\"", "\"Hz\""}},
        BadExperimentInput{"frequency_too_high", "to: 4 Hz", "to: 50 Hz", {":10", "50 Hz", "below 50 Hz"}},
        BadExperimentInput{"steps_not_whole", "steps: 2", "steps: 2.5", {":10", "whole number"}},
        BadExperimentInput{"one_step", "steps: 2", "steps: 1", {":10", "steps must be 2 or more"}},
        BadExperimentInput{"lengths", "amplitudes: [5]", "amplitudes: [5, 6]", {":14", "same length"}},
        BadExperimentInput{"after_the_end", "times: [1 s]", "times: [3 s]", {":16", "before the end at 2 s"}},
        BadExperimentInput{"not_a_list", "times: [1 s]", "times: 1 s", {":16", "a list"}},
        BadExperimentInput{
            "level_is_text", "value: 100", "value: much", {":11: commands.mLeg.2.value", "\"much\""}}),
    [](const auto& bad) { return std::string(bad.param.name); });

}  // namespace
}  // namespace plumbline::validation
