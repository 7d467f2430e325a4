// Each bad model.yaml gives one line: file, line, key, found, expected.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "simulator/model/robot_reader.h"
#include "tests/model/robot_texts.h"
#include "tests/model/test_laws.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

/// `from` in the good model becomes `to`; the message must name the line of `at_text` (its first occurrence
/// behind the change's begin; the change itself when empty).
struct Bad {
  std::string from, to, at_text, key, found, expected;
};

int line_at(const std::string& text, std::size_t position) {
  return 1 + static_cast<int>(
                 std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n'));
}

class BadModelTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("arm.sdf", test::kSkeleton);
    skeleton_ = read_skeleton(folder_.path("arm.sdf"));
  }

  void check(const Bad& bad) {
    std::string text = test::kModel;
    const std::size_t at = text.find(bad.from);
    ASSERT_NE(at, std::string::npos) << bad.from;
    text.replace(at, bad.from.size(), bad.to);
    const std::size_t marked = bad.at_text.empty() ? at : text.find(bad.at_text);
    ASSERT_NE(marked, std::string::npos) << bad.at_text;
    const std::string path = folder_.write("model.yaml", text);
    const std::string message = test::refusal(
        [&] { read_model(path, test::test_catalogue(), [this](const std::string&) { return skeleton_; }); });
    const std::string key = bad.key.empty() ? "" : bad.key + ": ";
    const std::string begin =
        path + ":" + std::to_string(line_at(text, marked)) + ": " + key + "found " + bad.found;
    EXPECT_EQ(message.rfind(begin, 0), 0U) << message << "\nshould begin with\n" << begin;
    EXPECT_NE(message.find(", expected "), std::string::npos) << message;
    EXPECT_NE(message.find(bad.expected), std::string::npos) << message << "\nshould contain\n"
                                                             << bad.expected;
  }

  void check_all(const std::vector<Bad>& table) {
    for (const Bad& bad : table) {
      SCOPED_TRACE(bad.from + " -> " + bad.to);
      check(bad);
    }
  }

  test::TemporaryFolder folder_;
  Skeleton skeleton_;
};

TEST_F(BadModelTest, Keys) {
  check_all({
      {"robot: test arm", "robott: test arm", "", "robott", "an unknown key", "did you mean robot?"},
      {"robot: test arm\n", "", "plumbline", "", "no \"robot\"", "the key \"robot\""},
      {"model/1", "model/2", "", "plumbline", "\"model/2\"", "`plumbline: model/1`"},
      {"plumbline: model/1\n", "", "robot", "", "no version line",
       "\"plumbline: model/1\" as the first line"},
      {"unit: N m, assumed", "unitt: N m, assumed", "", "motors.mRail.torque_limit.unitt", "an unknown key",
       "did you mean unit?"},
      {"    torque_limit", "    torque_limits", "torque_limits", "motors.mRail.torque_limits",
       "an unknown key", "did you mean torque_limit?"},
      {"    command_unit: V\n", "", "mRail:", "motors.mRail", "no \"command_unit\"", "the key"},
      {"    rotor_inertia: {value: 20", "    inertia: {value: 20", "inertia: {value: 20",
       "motors.mRail.inertia", "an unknown key", "rotor_inertia"},
      {"robot: test arm", "robot: test arm\nrobot: other", "robot: other", "robot", "this key twice", "once"},
      {"  mTip:\n    command", "  mRail:\n    command", "  mRail:\n    command_unit: N m", "motors.mRail",
       "this key twice", "once"},
      {"  - effect: drag\n    at: mTip", "  - effect: drag", "effect: drag", "effects.1", "no \"at\"",
       "the key \"at\""},
      {"    measures: rail\n", "", "qRail", "sensors.qRail", "no \"measures\"", "the key"},
      {"robot: test arm", "robot:", "", "robot", "nothing", "a text"},
      {"robot: test arm", "robot: [a]", "", "robot", "a list", "a text"},
      {"masses:\n", "masses: 3\n", "  upper: {unc", "", "text that is no YAML", "a whole YAML file"},
      {"{of: {rail: 1}}", "3", "", "coordinates.rail", "\"3\"", "a map"},
  });
}

TEST_F(BadModelTest, YamlThatIsCutOrBroken) {
  check_all({
      {"unit: \"1\", source: \"drawing\"}\n    also", "unit: \"1", "      shoulder: {value: 3", "",
       "text that is no YAML", "a whole YAML file"},
      {"skeleton: arm.sdf", "\tskeleton: arm.sdf", "", "", "text that is no YAML", "a whole YAML file"},
      {"robot: test arm", "robot: *nothing", "", "", "text that is no YAML", "a whole YAML file"},
      {"robot: test arm", "robot test arm", "skeleton", "", "text that is no YAML", "a whole YAML file"},
      {"robot: test arm", "? [a, b]\n: c", "", "key", "a list", "a name as key"},
  });
}

TEST_F(BadModelTest, Quantities) {
  check_all({
      {"value: 20,", "value: twenty,", "", "motors.mRail.rotor_inertia.value", "\"twenty\"",
       "a finite number"},
      {"value: 20,", "value: .inf,", "", "motors.mRail.rotor_inertia.value", "\".inf\"", "a finite number"},
      {"value: 20,", "value: .nan,", "", "motors.mRail.rotor_inertia.value", "\".nan\"", "a finite number"},
      {"value: 20,", "value: 1e999,", "", "motors.mRail.rotor_inertia.value", "\"1e999\"", "a finite number"},
      {"value: 20,", "value: -20,", "", "motors.mRail.rotor_inertia.value", "\"-20\"", "above zero"},
      {"value: 20,", "value: 0,", "", "motors.mRail.rotor_inertia.value", "\"0\"", "above zero"},
      {"value: 20,", "", "", "motors.mRail.rotor_inertia", "no \"value\"", "the key \"value\""},
      {"unit: g cm^2,", "", "", "motors.mRail.rotor_inertia", "no \"unit\"", "the key \"unit\""},
      {"unit: g cm^2,", "unit: N m,", "", "motors.mRail.rotor_inertia.unit", "unit \"N m\"", "\"kg m^2\""},
      {"unit: g cm^2,", "unit: gcm2,", "", "motors.mRail.rotor_inertia.unit", "unknown unit \"gcm2\"",
       "\"kg m^2\""},
      {"uncertainty: 5 %, source: \"Table 2\"", "uncertainty: 5 %", "value: 20", "motors.mRail.rotor_inertia",
       "no source", "assumed: reason"},
      {"source: \"Table 2\"}", "source: \"a\", assumed: b}", "", "motors.mRail.rotor_inertia.assumed",
       "both source and assumed", "one of them"},
      {"source: \"Table 2\"}", "source: \"\"}", "", "motors.mRail.rotor_inertia.source", "\"\"", "a text"},
      {"uncertainty: 5 %", "uncertainty: -5 %", "", "motors.mRail.rotor_inertia.uncertainty", "\"-5 %\"",
       "not negative"},
      {"uncertainty: 5 %", "uncertainty: 5 kg", "", "motors.mRail.rotor_inertia.uncertainty", "\"5 kg\"",
       "not negative"},
      {"uncertainty: 5 %", "uncertainty: \"%\"", "", "motors.mRail.rotor_inertia.uncertainty", "\"%\"",
       "not negative"},
      {"{value: 9.81, unit: m/s^2, assumed: \"a round number\"}", "9.81", "", "gravity", "\"9.81\"",
       "a map {value"},
      {"value: 9.81", "value: -9.81", "", "gravity.value", "\"-9.81\"", "not negative"},
      {"factory: 33", "factory: 0", "", "motors.mRail.torque_constant.factory", "\"0\"", "above zero"},
      {"unit: mN m/V", "unit: N m/A", "", "motors.mRail.torque_constant.unit", "unit \"N m/A\"", "\"N m/V\""},
      {"unit: N m, assumed", "unit: N, assumed", "", "motors.mRail.torque_limit.unit", "unit \"N\"",
       "\"N m\""},
      {"command_unit: V", "command_unit: N", "", "motors.mRail.command_unit", "unit \"N\"", "N m, A or V"},
      {"    torque_constant: {value: 30, unit: mN m/V, uncertainty: 1, source: \"Table 2\", factory: 33}\n",
       "", "mRail:", "motors.mRail", "no \"torque_constant\"", "the key"},
  });
}

TEST_F(BadModelTest, Names) {
  check_all({
      {"  upper: {unc", "  uper: {unc", "", "masses.uper", "\"uper\"", "did you mean upper?"},
      {"of: {rail: 1}", "of: {rial: 1}", "", "coordinates.rail.of.rial", "\"rial\"", "did you mean rail?"},
      {"of: {rail: 1}", "of: {rail: 0}", "", "coordinates.rail.of.rail", "\"0\"", "not zero"},
      {"of: {rail: 1}", "of: {}", "", "coordinates.rail.of", "no joints", "{joint: factor"},
      {"of: {shoulder: 1, elbow: 0.5}", "of: {shoulder: 1, rail: 0.5}", "", "coordinates.tip.of.rail",
       "a linear joint beside rotary ones", "one kind"},
      {"rail: {of: {rail: 1}}", "rail: {of: {rail: 2}}", "", "coordinates.rail", "the name of a joint",
       "exactly this joint"},
      {"  tip: {of", "  elbow: {of", "", "coordinates.elbow", "the name of a joint", "exactly this joint"},
      {"  mTip:\n", "  tip:\n", "  tip:\n", "motors.tip", "the name of a joint or coordinate",
       "only this motor"},
      {"  mTip:\n", "  elbow:\n", "  elbow:\n", "motors.elbow", "the name of a joint or coordinate",
       "only this motor"},
      {"  mTip:\n", "  m Tip:\n", "  m Tip:\n", "motors.m Tip", "name \"m Tip\"", "letters"},
      {"motor: mRail", "motor: mRial", "", "ratios.rail.motor", "\"mRial\"", "did you mean mRail?"},
      {"      shoulder: {value: 3", "      sholder: {value: 3", "", "ratios.tip.also.sholder", "\"sholder\"",
       "did you mean shoulder?"},
      {"      shoulder: {value: 3", "      tip: {value: 3", "", "ratios.tip.also.tip",
       "this coordinate twice", "once"},
      {"value: 0.1, unit: rad/mm", "value: 0, unit: rad/mm", "", "ratios.rail.ratio.value", "\"0\"",
       "not zero"},
      {"value: 0.1, unit: rad/mm", "value: 0.1, unit: \"1\"", "", "ratios.rail.ratio.unit", "unit \"1\"",
       "\"rad/m\""},
      {"    at: mTip\n    value:", "    at: mTop\n    value:", "at: mTop", "inertias.pulley.at", "\"mTop\"",
       "did you mean mTip?"},
      {"measures: mTip", "measures: mTop", "", "sensors.qTip.measures", "\"mTop\"", "did you mean mTip?"},
      {"counts_per_turn: 2048", "counts_per_turn: 0", "", "sensors.qTip.counts_per_turn", "\"0\"",
       "above zero"},
      {"gear: 2", "gear: -2", "", "sensors.qTip.gear", "\"-2\"", "above zero"},
      {"    counts_per_turn: 2048\n", "", "gear: 2", "sensors.qTip.gear", "a gear without counts_per_turn",
       "both"},
      {"    resolution: {value: 1, unit: um", "    counts_per_turn: 5\n    resolution: {value: 1, unit: um",
       "", "sensors.qRail.counts_per_turn", "both resolution and", "one of them"},
      {"    resolution: {value: 1, unit: um, source: \"data sheet\"}", "    counts_per_turn: 5", "",
       "sensors.qRail.counts_per_turn", "counts per turn where none are counted", "resolution"},
      {"unit: um", "unit: deg", "", "sensors.qRail.resolution.unit", "unit \"deg\"", "\"m\""},
      {"skeleton: arm.sdf", "skeleton: leg.sdf", "", "skeleton", "\"leg.sdf\", where there is no file",
       "relative to this file"},
      {"skeleton: arm.sdf", "skeleton: arm.stl", "", "skeleton", "\"arm.stl\"", ".sdf, .urdf or .xml"},
  });
}

TEST_F(BadModelTest, Pulleys) {
  const auto with = [](const std::string& pulleys) { return "pulleys:\n" + pulleys + "inertias:\n"; };
  const std::string good = "  drum: {inertia: {value: 1, unit: g m^2, source: s}}\n";
  check_all({
      {"inertias:\n", with("  drum: {}\n"), "  drum:", "pulleys.drum", "no \"inertia\"", "the key"},
      {"inertias:\n", with("  drum: 3\n"), "  drum:", "pulleys.drum", "\"3\"", "a map"},
      {"inertias:\n", with("  drum: {inertia: {value: 0, unit: kg m^2, source: s}}\n"),
       "  drum:", "pulleys.drum.inertia.value", "\"0\"", "above zero"},
      {"inertias:\n", with("  drum: {inertia: {value: 1, unit: kg, source: s}}\n"),
       "  drum:", "pulleys.drum.inertia.unit", "unit \"kg\"", "\"kg m^2\""},
      {"inertias:\n", with("  drum: {inertia: {value: 1, unit: kg m^2}}\n"),
       "  drum:", "pulleys.drum.inertia", "no source", "assumed: reason"},
      {"inertias:\n", with("  drum: {inertia: {value: 1, unit: g m^2, source: s}, command_unit: V}\n"),
       "  drum:", "pulleys.drum.command_unit", "an unknown key", "inertia"},
      {"inertias:\n", with("  elbow: {inertia: {value: 1, unit: g m^2, source: s}}\n"), "  elbow: {i",
       "pulleys.elbow", "the name of a joint, coordinate or motor", "only this pulley"},
      {"inertias:\n", with("  mTip: {inertia: {value: 1, unit: g m^2, source: s}}\n"), "  mTip: {i",
       "pulleys.mTip", "the name of a joint, coordinate or motor", "only this pulley"},
      {"inertias:\n", with("  tip: {inertia: {value: 1, unit: g m^2, source: s}}\n"), "  tip: {i",
       "pulleys.tip", "the name of a joint, coordinate or motor", "only this pulley"},
      {"inertias:\n", with("  a drum: {inertia: {value: 1, unit: g m^2, source: s}}\n"), "  a drum",
       "pulleys.a drum", "name \"a drum\"", "letters"},
      {"inertias:\n",
       "  drum:\n    pulley: drim\n    of: {tip: {value: 2, unit: \"1\", source: s}}\n" + with(good),
       "    pulley: drim", "ratios.drum.pulley", "\"drim\"", "a pulley; did you mean drum?"},
      {"inertias:\n",
       "  drum:\n    pulley: drum\n    of: {rail: {value: 2, unit: \"1\", source: s}}\n" + with(good),
       "    of: {rail", "ratios.drum.of.rail.unit", "unit \"1\"", "\"rad/m\""},
      {"inertias:\n", "    pulley: drum\n" + with(good), "    pulley: drum", "ratios.tip.pulley",
       "this key beside `motor`", "either motor and ratio, or joint (or pulley) and of"},
      {"of: {shoulder: 1, elbow: 0.5}", "of: {shoulder: 1, drum: 0.5}", "", "coordinates.tip.of.drum",
       "\"drum\"", "the name of a moving joint of the skeleton"},
  });
}

TEST_F(BadModelTest, Effects) {
  check_all({
      {"effect: drag", "effect: drug", "", "effects.1.effect", "\"drug\"", "did you mean drag?"},
      {"at: mTip\n    values", "at: mTop\n    values", "", "effects.1.at", "\"mTop\"",
       "a coordinate or motor; did you mean mTip?"},
      {"      damping: {", "      damp: {", "", "effects.1.values.damp", "an unknown parameter",
       "did you mean damping?"},
      {"value: 0.3,", "value: 11,", "", "effects.1.values.damping.value", "11 (SI)", "from 0 to 10 (SI)"},
      {"value: 0.3,", "value: .inf,", "", "effects.1.values.damping.value", "\".inf\"", "a finite number"},
      {"unit: N m s/rad", "unit: N s/m", "", "effects.1.values.damping.unit", "unit \"N s/m\"",
       "\"N m s/rad\""},
      {"unit: kN/m", "unit: N m/rad", "", "effects.3.values.stiffness.unit", "unit \"N m/rad\"", "\"N/m\""},
      {"side: {value: 1", "side: {value: -1", "- effect: stop\n    at: rail\n    values:\n      side",
       "effects.3", "stop at rail twice", "once"},
      {"{effect: stretch, at: tip}",
       "{effect: stretch, at: tip, values: {stiffness: {value: .inf, unit: N m/rad, uncertainty: 5 %, "
       "source: s}}}",
       "", "effects.4.values.stiffness.uncertainty", "\"5 %\"", "a finite uncertainty"},
      {"{effect: stretch, at: tip}",
       "{effect: stretch, at: tip, values: {stiffness: {value: -.inf, unit: N m/rad, source: s}}}", "",
       "effects.4.values.stiffness.value", "-.inf", "from 0"},
      {"{effect: stretch, at: tip}", "stretch", "", "effects.4", "\"stretch\"", "a map"},
  });
}

TEST_F(BadModelTest, RatiosThatRepeatOrContradict) {
  check_all({
      {"  tip:\n    motor: mTip",
       "  twice: {joint: elbow, of: {shoulder: {value: 2, unit: \"1\", source: s}}}\n  again: {joint: elbow, "
       "of: {shoulder: {value: 2, unit: \"1\", source: s}}}\n  tip:\n    motor: mTip",
       "  again:", "ratios.again", "a ratio that follows from those before it", "independent"},
      {"  tip:\n    motor: mTip",
       "  twice: {joint: elbow, of: {shoulder: {value: 2, unit: \"1\", source: s}}}\n  again: {joint: elbow, "
       "of: {shoulder: {value: 3, unit: \"1\", source: s}}}\n  tip:\n    motor: mTip",
       "  again:", "ratios.again", "ratios that contradict each other", "free to move"},
      {"motor: mTip\n    ratio: {value: -20, unit: \"1\", source: \"drawing\"}\n    also:\n      shoulder: "
       "{value: 3, unit: \"1\", source: \"drawing\"}",
       "motor: mRail\n    ratio: {value: -20, unit: \"1\", source: \"drawing\"}", "  mTip:", "motors.mTip",
       "a motor that drives nothing", "a ratio"},
      {"  tip:\n    motor: mTip",
       "  self: {joint: shoulder, of: {shoulder: {value: 1, unit: \"1\", source: s}}}\n  tip:\n    motor: "
       "mTip",
       "  self:", "ratios.self", "a ratio that follows", "independent"},
      {"  tip:\n    motor: mTip", "  tip:\n    joint: elbow\n    motor: mTip", "joint: elbow",
       "ratios.tip.joint", "this key beside `motor`", "either"},
  });
}

TEST_F(BadModelTest, RefusesWhatIsNoMapOrNoFile) {
  const auto message = [&](const std::string& text) {
    const std::string path = folder_.write("model.yaml", text);
    return test::refusal([&] { read_model(path, test::test_catalogue()); });
  };
  EXPECT_NE(message("").find("model.yaml:1: found nothing, expected a map"), std::string::npos);
  EXPECT_NE(message("- a\n").find("model.yaml:1: found a list, expected a map"), std::string::npos);
  EXPECT_NE(message(test::kModel + "---\na: b\n").find("found more than one YAML document"),
            std::string::npos);
  EXPECT_NE(message(std::string(100000, '[')).find("no YAML"), std::string::npos);
  EXPECT_NE(test::refusal([&] {
              read_model(folder_.path("none.yaml"), test::test_catalogue());
            }).find("found nothing"),
            std::string::npos);
}

}  // namespace
}  // namespace plumbline::model
