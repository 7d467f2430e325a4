// Every way in which a trial can be wrong, and the one line that says so.
#include <algorithm>
#include <ostream>

#include "tests/identify/trial/fixture.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {
namespace {

struct BadInput {
  const char* name;
  bool in_data;  ///< the change is made in data.csv, otherwise in trial.yaml
  const char* what;
  const char* by;
  std::vector<const char*> message;  ///< parts that the message must have
};

void PrintTo(const BadInput& bad, std::ostream* out) { *out << bad.name; }

class BadTrial : public ScratchFolder, public testing::WithParamInterface<BadInput> {};

TEST_P(BadTrial, IsRefusedInOneClearLine) {
  const BadInput& bad = GetParam();
  write_file(folder / "trial.yaml", bad.in_data ? good_trial() : replaced(good_trial(), bad.what, bad.by));
  write_file(folder / "data.csv", bad.in_data ? replaced(good_csv(), bad.what, bad.by) : good_csv());
  const std::string message = input_error([&] { read_trial(folder.string(), robot); });
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 0) << message;
  EXPECT_NE(message.find(folder.string()), std::string::npos) << message;
  for (const char* part : bad.message) {
    EXPECT_NE(message.find(part), std::string::npos) << "no `" << part << "` in: " << message;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Yaml, BadTrial,
    testing::Values(
        BadInput{"no_version", false, "plumbline: trial/1\n", "", {"no version line", "plumbline: trial/1"}},
        BadInput{"other_version",
                 false,
                 "trial/1",
                 "trial/2",
                 {"trial.yaml:1: plumbline", "\"trial/2\"", "trial/1"}},
        BadInput{"model_file", false, "trial/1", "model/1", {"trial.yaml:1", "\"model/1\"", "trial/1"}},
        BadInput{
            "unknown_key", false, "locked:", "loked:", {"trial.yaml:13: loked", "unknown key", "locked?"}},
        BadInput{"key_twice",
                 false,
                 "title: A test",
                 "title: A test\nrole: train",
                 {"trial.yaml:5: role", "twice"}},
        BadInput{"no_title", false, "title: A test\n", "", {"no \"title\""}},
        BadInput{"no_model", false, "model: ../robots/robot.yaml\n", "", {"no \"model\""}},
        BadInput{"no_data", false, "data: data.csv\n", "", {"no \"data\""}},
        BadInput{"no_time", false, "time: {column: t, unit: s}\n", "", {"no \"time\""}},
        BadInput{"no_role", false, "role: train\n", "", {"no \"role\""}},
        BadInput{
            "other_role",
            false,
            "role: train",
            "role: held_out",
            {"trial.yaml:4: role: found \"held_out\"", "train, held-out or test", "did you mean held-out?"}},
        BadInput{"cut_off", false, "{column: t, unit: s}", "{column: t, unit", {"no YAML"}},
        BadInput{"no_such_data", false, "data.csv", "date.csv", {"date.csv", "nothing at this path"}},
        BadInput{
            "data_of_another_kind", false, "data: data.csv", "data: trial.yaml", {"extension .yaml", ".mat"}},
        BadInput{"unknown_sensor",
                 false,
                 "  angle:",
                 "  angl:",
                 {"trial.yaml:11: measured.angl", "sensor \"angl\"", "did you mean angle?"}},
        BadInput{"unknown_motor",
                 false,
                 "  mLeg:",
                 "  mleg:",
                 {"trial.yaml:8: commands.mleg", "motor \"mleg\"", "did you mean mLeg?"}},
        BadInput{"unknown_lock",
                 false,
                 "  leg: {value",
                 "  lag: {value",
                 {"trial.yaml:14: locked.lag", "coordinate, motor or pulley", "did you mean leg?"}},
        BadInput{"sensor_twice",
                 false,
                 "  place: {column: place}",
                 "  angle: {column: place}",
                 {"trial.yaml:12: measured.angle", "twice"}},
        BadInput{"nothing_measured",
                 false,
                 "  angle: {column: angle, unit: deg}\n  place: {column: place}\n",
                 "",
                 {"measured", "a map"}},
        BadInput{
            "misspelt_column",
            false,
            "{column: u, unit: N m}",
            "{column: refference, unit: N m}",
            {"trial.yaml:8: commands.mLeg.column", "\"refference\"", "data.csv", "did you mean reference?"}},
        BadInput{"column_used_twice",
                 false,
                 "{column: place}",
                 "{column: angle}",
                 {"trial.yaml:12: measured.place.column", "\"angle\" a second time"}},
        BadInput{
            "time_as_measured", false, "{column: place}", "{column: t}", {"trial.yaml:12", "a second time"}},
        BadInput{"reference_is_the_measurement",
                 false,
                 "{column: reference}",
                 "{column: place}",
                 {"trial.yaml:20", "a second time"}},
        BadInput{"no_column", false, "{column: place}", "{unit: mm}", {"trial.yaml:12", "no \"column\""}},
        BadInput{"column_without_map", false, "{column: place}", "place", {"trial.yaml:12", "a map {column"}},
        BadInput{"unknown_unit",
                 false,
                 "unit: N m}",
                 "unit: Nxm}",
                 {"trial.yaml:8: commands.mLeg.unit", "unknown unit \"Nxm\"", "\"N m\"", "motor mLeg"}},
        BadInput{"wrong_command_unit",
                 false,
                 "unit: N m}",
                 "unit: V}",
                 {"trial.yaml:8: commands.mLeg.unit", "unit \"V\"", "like \"N m\"", "motor mLeg"}},
        BadInput{"wrong_sensor_unit",
                 false,
                 "unit: deg}\n  place",
                 "unit: mm}\n  place",
                 {"trial.yaml:11: measured.angle.unit", "unit \"mm\"", "like \"rad\"", "sensor angle"}},
        BadInput{"resolution_of_wrong_unit",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, resolution: {value: 1, unit: mm}}\n  place",
                 {"trial.yaml:11: measured.angle.resolution.unit", "\"mm\"", "like \"rad\"", "sensor angle"}},
        BadInput{"noise_below_zero",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, noise: {value: -1, unit: deg}}\n  place",
                 {"trial.yaml:11: measured.angle.noise", "below zero", "zero or more"}},
        BadInput{"no_floor_left",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, resolution: {value: 0, unit: deg}}\n  place",
                 {"trial.yaml:11: measured.angle", "neither resolution nor noise", "floor"}},
        BadInput{"offset_uncertainty_is_a_quantity",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, offset_uncertainty: 1}\n  place",
                 {"trial.yaml:11: measured.angle.offset_uncertainty", "a map {value"}},
        BadInput{"counts_are_no_angle",
                 false,
                 "unit: deg}\n  place",
                 "unit: count}\n  place",
                 {"trial.yaml:11", "unit \"count\"", "like \"rad\"", "resolution"}},
        BadInput{"other_unit_than_the_data",
                 false,
                 "unit: deg}\n  place",
                 "unit: rad}\n  place",
                 {"trial.yaml:11", "\"rad\"", "\"deg\"", "data.csv"}},
        BadInput{
            "wrong_time_unit", false, "unit: s}", "unit: m}", {"trial.yaml:6: time.unit", "\"m\"", "\"s\""}},
        BadInput{"lock_without_unit",
                 false,
                 "{value: 90, unit: deg}",
                 "{value: 90}",
                 {"trial.yaml:14", "no \"unit\""}},
        BadInput{"lock_of_wrong_unit",
                 false,
                 "{value: 5, unit: mm}",
                 "{value: 5, unit: deg}",
                 {"trial.yaml:15: locked.drive.unit", "\"deg\"", "\"m\""}},
        BadInput{
            "lock_is_text", false, "value: 90", "value: up", {"trial.yaml:14: locked.leg.value", "\"up\""}},
        BadInput{"unknown_controller", false, "cascade_pd", "cascade_pid", {"trial.yaml:17", "cascade_pd?"}},
        BadInput{"controller_motor",
                 false,
                 "motor: drive",
                 "motor: drife",
                 {"trial.yaml:18", "did you mean drive?"}},
        BadInput{
            "controller_sensor", false, "sensor: place", "sensor: plaice", {"trial.yaml:19", "mean place?"}},
        BadInput{
            "controller_key", false, "command_limit", "commandlimit", {"trial.yaml:23", "command_limit?"}},
        BadInput{
            "gain_of_wrong_unit", false, "V s/mm", "V s/rad", {"trial.yaml:22", "\"V s/rad\"", "\"V s/m\""}},
        BadInput{"gain_without_source",
                 false,
                 "unit: 1/s, source: test",
                 "unit: 1/s",
                 {"trial.yaml:21", "source"}},
        BadInput{"limit_of_zero",
                 false,
                 "{value: 10, unit: V}",
                 "{value: 0, unit: V}",
                 {"trial.yaml:23", "above zero"}},
        BadInput{"velocity_over_three",
                 false,
                 "velocity_over: 2",
                 "velocity_over: 3",
                 {"trial.yaml:24", "1 or 2"}},
        BadInput{"velocity_over_half",
                 false,
                 "velocity_over: 2",
                 "velocity_over: 1.5",
                 {"trial.yaml:24", "1 or 2"}},
        BadInput{
            "second_controller_of_a_motor",
            false,
            "events: [0.1 s, 200 ms]\n",
            "  - {kind: cascade_pd, motor: drive, sensor: place, reference: {column: reference}, "
            "position_gain: "
            "{value: 1, unit: 1/s, source: test}, velocity_gain: {value: 1, unit: V s/m, source: test}}\n",
            {"trial.yaml:25: controllers.2", "second controller of motor drive", "one for each"}},
        BadInput{"event_without_unit", false, "[0.1 s", "[0.1", {"trial.yaml:25", "\"0.1\"", "unit"}},
        BadInput{"events_out_of_order", false, "[0.1 s", "[0.25 s", {"trial.yaml:25", "rise"}},
        BadInput{"event_outside", false, "200 ms", "200 s", {"events", "200 s", "within the recording"}}),
    [](const auto& bad) { return std::string(bad.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Log, BadTrial,
    testing::Values(
        BadInput{"resample_is_a_word",
                 false,
                 "unit: s}",
                 "unit: s, resample: yes}",
                 {"trial.yaml:6: time.resample", "\"yes\"", "{value: 5, unit: ms}", "even"}},
        BadInput{"resample_of_wrong_unit",
                 false,
                 "unit: s}",
                 "unit: s, resample: {value: 5, unit: Hz}}",
                 {"trial.yaml:6: time.resample.unit", "\"Hz\"", "\"s\""}},
        BadInput{"resample_to_nothing",
                 false,
                 "unit: s}",
                 "unit: s, resample: {value: 0, unit: ms}}",
                 {"trial.yaml:6: time.resample", "not above zero"}},
        BadInput{"resample_too_slowly",
                 false,
                 "unit: s}",
                 "unit: s, resample: {value: 50, unit: ms}}",
                 {"data.csv: t", "period of 50 ms", "at least 20 samples"}},
        BadInput{
            "sections_in_disorder",
            false,
            "commands:\n",
            "section: [{from: {value: 0.2, unit: s}, to: {value: 0.25, unit: s}}, {from: {value: 0, unit: "
            "s}, to: {value: 0.1, unit: s}}]\ncommands:\n",
            {"trial.yaml:7: section.2", "begins before the one before it ends"}},
        BadInput{"no_section", false, "commands:\n", "section: []\ncommands:\n", {"section", "no sections"}},
        BadInput{"left_out_is_elsewhere",
                 false,
                 "commands:\n",
                 "leave_out: {from: {value: 1, unit: s}, to: {value: 2, unit: s}}\ncommands:\n",
                 {"trial.yaml:7: leave_out", "1 to 2 s", "lasts from 0 to 0.29 s"}},
        BadInput{"nothing_is_left",
                 false,
                 "commands:\n",
                 "leave_out: {from: {value: 0, unit: s}, to: {value: 290, unit: ms}}\ncommands:\n",
                 {"no sample that is in no gap"}},
        BadInput{"missing_policy",
                 false,
                 "commands:\n",
                 "missing: fil\ncommands:\n",
                 {"trial.yaml:7: missing", "\"fil\"", "did you mean fill?"}},
        BadInput{"scale_of_zero",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, scale: 0}\n  place",
                 {"trial.yaml:11: measured.angle.scale", "not zero"}},
        BadInput{"offset_of_wrong_unit",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, offset: {value: 1, unit: m}}\n  place",
                 {"trial.yaml:11: measured.angle.offset.unit", "\"m\""}},
        BadInput{"slide_that_wraps",
                 false,
                 "{column: place}",
                 "{column: place, unwrap: true}",
                 {"trial.yaml:12: measured.place.unwrap", "nothing turns", "{value: ..., unit: m}"}},
        BadInput{"unwrap_is_no_flag",
                 false,
                 "unit: deg}\n  place",
                 "unit: deg, unwrap: 360}\n  place",
                 {"trial.yaml:11: measured.angle.unwrap", "true or false"}},
        BadInput{"clock_shift",
                 false,
                 "commands:\n",
                 "clock_shift_uncertainty: {value: 1, unit: m}\ncommands:\n",
                 {"trial.yaml:7: clock_shift_uncertainty.unit", "\"m\"", "\"s\""}},
        BadInput{"pd_beside_a_recorded_command",
                 false,
                 "kind: cascade_pd",
                 "kind: pd",
                 {"trial.yaml:21: controllers.1.position_gain", "V/m"}},
        BadInput{
            "no_number_for_a_word", true, "\n0.07,0.7,7,", "\n0.07,off,7,", {"data.csv:9: u", "\"off\""}}),
    [](const auto& bad) { return std::string(bad.param.name); });

INSTANTIATE_TEST_SUITE_P(
    Data, BadTrial,
    testing::Values(
        BadInput{"column_missing",
                 true,
                 ",place [mm]",
                 ",plac [mm]",
                 {"trial.yaml:12: measured.place.column", "\"place\"", "did you mean plac?"}},
        BadInput{"column_twice", true, ",place [mm]", ",angle [mm]", {"data.csv:1: angle", "twice"}},
        BadInput{"unit_missing",
                 true,
                 "place [mm]",
                 "place",
                 {"trial.yaml:12: measured.place.column", "no unit for column \"place\"", "`unit: m`"}},
        BadInput{"unit_of_wrong_kind",
                 true,
                 "place [mm]",
                 "place [deg]",
                 {"data.csv:1: place", "unit \"deg\"", "like \"m\"", "sensor place"}},
        BadInput{
            "not_a_number", true, "\n0.07,0.7,7,", "\n0.07,nan,7,", {"data.csv:9: u", "\"nan\"", "finite"}},
        BadInput{"infinite", true, "\n0.07,0.7,7,", "\n0.07,inf,7,", {"data.csv:9: u", "\"inf\"", "finite"}},
        BadInput{"empty_field", true, "\n0.07,0.7,7,", "\n0.07,,7,", {"data.csv:9: u", "empty"}},
        BadInput{"ragged", true, "\n0.07,0.7,7,7,", "\n0.07,0.7,7,", {"data.csv:9", "5 fields", "6"}},
        BadInput{"time_goes_back",
                 true,
                 "\n0.07,",
                 "\n0.055,",
                 {"data.csv: t", "time 0.055 s in row 8", "above 0.06 s"}},
        BadInput{"time_repeated", true, "\n0.07,", "\n0.06,", {"data.csv: t", "again, 0.06 s in row 8"}}),
    [](const auto& bad) { return std::string(bad.param.name); });

class BadData : public ScratchFolder {};

TEST_F(BadData, FewerThanTwentySamples) {
  const std::string csv = good_csv();
  std::size_t end = 0;
  for (int line = 0; line < 20; ++line) {
    end = csv.find('\n', end) + 1;
  }
  write_file(folder / "trial.yaml", replaced(good_trial(), "events: [0.1 s, 200 ms]\n", ""));
  write_file(folder / "data.csv", csv.substr(0, end));
  const std::string message = input_error([&] { read_trial(folder.string(), robot); });
  EXPECT_NE(message.find("found 19 samples, expected at least 20"), std::string::npos) << message;
  write_file(folder / "data.csv", csv.substr(0, csv.find('\n', end) + 1));
  EXPECT_EQ(read_trial(folder.string(), robot).samples(), 20);
}

TEST_F(BadData, NoTrialAtAll) {
  for (const std::string& path : {folder.string(), (folder / "no.yaml").string()}) {
    const std::string message = input_error([&] { read_trial(path, robot); });
    EXPECT_NE(message.find("nothing at this path"), std::string::npos) << message;
    EXPECT_EQ(input_error([&] { model_of_trial(path); }), message);
  }
}

}  // namespace
}  // namespace plumbline::validation
