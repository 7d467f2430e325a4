// Closed loops from files: what is read, and what is refused in one line.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "simulator/model/body_poses.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/positions_from.h"
#include "simulator/model/robot_file.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string text_of(const std::string& name) {
  std::ifstream in(PLUMBLINE_ROOT "/tests/robots/four_bar/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

class LoopFiles : public testing::Test {
 protected:
  void SetUp() override { folder_.write("four_bar.sdf", text_of("four_bar.sdf")); }

  Model read(const std::string& text) const {
    return read_model(folder_.write("model.yaml", text), known_effects());
  }
  static std::string changed(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
  /// Of the four-bar leg with a change; `at` is the line's text, from its first letter.
  void expect_refused(const std::string& from, const std::string& to, const std::string& at,
                      const std::string& found) const {
    const std::string text = changed(text_of("model.yaml"), from, to);
    const std::string message = test::refusal([&] { Plant plant(read(text), {}); });
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(text.find(at));
    const auto line = std::to_string(1 + std::count(text.begin(), end, '\n'));
    EXPECT_THAT(message, StartsWith(folder_.path("model.yaml") + ":" + line + ": "));
    EXPECT_THAT(message, HasSubstr(found));
    EXPECT_THAT(message, HasSubstr("expected"));
  }
  test::TemporaryFolder folder_;
};

// The crossing of two circles about the crank's pin (280 mm) and the knee (120 mm); see the skeleton's
// comment.
TEST_F(LoopFiles, CloseWhereTheirCirclesCross) {
  Plant plant(read(text_of("model.yaml")), {});
  ASSERT_TRUE(plant.has_loops());
  EXPECT_EQ(plant.closure()->size(), 2);  // across the plane nothing is held
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  Eigen::VectorXd z = plant.home();
  ASSERT_TRUE(plant.closure()->close(Eigen::RowVector3d(1, 0, 0), Eigen::VectorXd::Zero(1), z));
  x.head(3) = z;
  const double along = (0.22 * 0.22 + 0.28 * 0.28 - 0.12 * 0.12) / (2.0 * 0.22);
  const double down = std::sqrt(0.28 * 0.28 - along * along);
  EXPECT_NEAR(plant.position_of("ankle", x.data()), std::atan2(down, along), 1e-14);
  EXPECT_NEAR(plant.position_of("knee", x.data()), -std::atan2(along - 0.22, down), 1e-14);
}

TEST_F(LoopFiles, AreRefusedInOneLine) {
  expect_refused("type: connect", "type: glue", "type:", "\"glue\"");
  expect_refused("link: shin, value: [0", "link: shank, value: [0", "- {link: shank",
                 "expected the name of a link");
  expect_refused("link: shin, value: [0", "link: coupler, value: [0", "between",
                 "both ends on the same link");
  expect_refused("value: [280, 0, 0]", "value: [280, 0]", "- {link: coupler", "2 numbers");
  expect_refused("unit: mm}", "unit: kg}", "- {link: coupler", "unit \"kg\"");
  expect_refused("knee: {value: -17", "toe: {value: -17", "toe:", "\"toe\"");
  expect_refused("source: \"drawing\"\n  near", "length: {value: 1, unit: m}\n  near", "length", "length");
  expect_refused("- {link: shin, value: [0, 0, -120], unit: mm}", "", "between", "1 end");
  // Too short by far: 80 + 60 + 120 mm do not span the base's 300.
  expect_refused("[280, 0, 0]", "[60, 0, 0]", "rocker_pin",
                 "no position of the joints was found to bring nearer");
  // Out of the plane by 1 cm.
  expect_refused("[280, 0, 0]", "[280, 10, 0]", "rocker_pin", "stay 0.01 m apart");
  expect_refused(
      "  near:",
      "  again:\n    type: rod\n    between:\n      - {link: coupler, value: [280, 0, 0], unit: mm}\n"
      "      - {link: shin, value: [0, 0, 0], unit: mm}\n    length: {value: 120, unit: mm, source: x}\n"
      "    source: x\n  near:",
      "again", "holds again");
}

// The knee is tied to the motor by the loop: one sensor shows the whole.
TEST_F(LoopFiles, OneEncoderShowsAllJoints) {
  const Model model = read(text_of("model.yaml"));
  const Plant plant(model, {});
  const PositionsFrom from(plant, {observe_sensor(plant, model.sensor_index("knee"))});
  EXPECT_TRUE(from.determined());
  const Eigen::MatrixXd knee = Eigen::RowVector3d(-0.35, -0.3, -0.25);
  const Eigen::MatrixXd z = from.positions(knee);
  const Eigen::MatrixXd w = from.rates(Eigen::RowVector3d(0.5, -1.0, 2.0), z, knee);
  Plant other(model, {});
  for (Eigen::Index k = 0; k < 3; ++k) {
    Eigen::VectorXd x(other.states());
    x << z.col(k), w.col(k);
    EXPECT_NEAR(other.position_of("knee", x.data()), knee(0, k), 1e-12);
    EXPECT_LT(other.loop_errors(x.data()).maxCoeff(), 1e-12);
  }
}

constexpr const char* kMjcf = R"(<mujoco><worldbody>
  <body name="crank"><joint name="hip" axis="0 1 0"/><inertial pos="0.04 0 0" mass="0.15" diaginertia="2e-5 1.2e-4 1.2e-4"/>
    <body name="coupler" pos="0.08 0 0"><joint name="ankle" axis="0 1 0" pos="0 0 0"/>
      <inertial pos="0.14 0 0" mass="0.2" diaginertia="2e-5 1.4e-3 1.4e-3"/></body></body>
  <body name="shin" pos="0.36 0 0.12"><joint name="knee" axis="0 1 0"/>
    <inertial pos="0 0 -0.15" mass="0.6" diaginertia="6e-3 6e-3 2e-4"/></body>
  </worldbody>
  <equality>LOOP<joint joint1="hip" joint2="knee" active="false"/><tendon tendon1="t"/></equality></mujoco>)";

// In the file's pose the coupler's end lies on the shin, 120 mm below the knee.
TEST_F(LoopFiles, MjcfConnectTakesTheSecondPointFromTheFilesPose) {
  const Skeleton skeleton = read_skeleton(folder_.write(
      "a.xml",
      changed(kMjcf, "LOOP", R"(<connect name="pin" body1="coupler" body2="shin" anchor="0.28 0 0"/>)")));
  ASSERT_EQ(skeleton.loops.size(), 1U);
  const Loop& loop = skeleton.loops.front();
  EXPECT_EQ(loop.name, "pin");
  EXPECT_LT((loop.ends[1].point - Eigen::Vector3d(0.0, 0.0, -0.12)).norm(), 1e-15);
  EXPECT_THAT(skeleton.left_out, testing::Contains(HasSubstr("<equality> with 1 element")));
  Model model;
  model.skeleton = skeleton;
  model.loops = skeleton.loops;
  EXPECT_LT(Plant(model, {}).home().norm(), 1e-12);
}

TEST_F(LoopFiles, MjcfWeldHoldsTheOrientationToo) {
  const Skeleton skeleton = read_skeleton(folder_.write(
      "a.xml",
      changed(kMjcf, "LOOP", R"(<weld body1="coupler" body2="shin" relpose="0.28 0 0.12 1 0 0 0"/>)")));
  ASSERT_EQ(skeleton.loops.size(), 1U);
  EXPECT_EQ(skeleton.loops.front().type, Loop::Type::weld);
  Model model;
  model.skeleton = skeleton;
  model.loops = skeleton.loops;
  EXPECT_THAT(test::refusal([&] { Plant plant(model, {}); }), HasSubstr("leave no joint free"));
}

TEST_F(LoopFiles, MjcfRefusesWhatIsNoLoopOfBodies) {
  const auto message = [&](const std::string& loop) {
    return test::refusal([&] { read_skeleton(folder_.write("a.xml", changed(kMjcf, "LOOP", loop))); });
  };
  EXPECT_THAT(message(R"(<connect site1="a" site2="b"/>)"), HasSubstr("a.xml:8: connect: found no body1"));
  EXPECT_THAT(message(R"(<connect body1="coupler" body2="shim" anchor="0 0 0"/>)"),
              HasSubstr("did you mean shin?"));
  EXPECT_THAT(message(R"(<connect body1="coupler" body2="shin"/>)"), HasSubstr("no anchor"));
  EXPECT_THAT(message(R"(<joint joint1="ancle" joint2="knee"/>)"), HasSubstr("did you mean ankle?"));
  EXPECT_THAT(message(R"(<joint joint1="ankle" joint2="knee" polycoef="0 1 0.5 0 0"/>)"),
              HasSubstr("a line: two coefficients"));
}

// q_coupled - ref_coupled = 0.1 - 2 (q_knee - ref_knee): turns from the file's pose, by hand.
TEST_F(LoopFiles, MjcfTiesAJointToAnotherByALine) {
  std::string text =
      changed(kMjcf, "LOOP", R"(<joint joint1="ankle" joint2="knee" polycoef="0.1 -2 0 0 0"/>)");
  text = changed(text, "<mujoco>", "<mujoco><compiler angle=\"radian\"/>");
  text = changed(text, "name=\"ankle\"", "name=\"ankle\" ref=\"0.3\"");
  text = changed(text, "name=\"knee\"", "name=\"knee\" ref=\"-0.2\"");
  const Skeleton skeleton = read_skeleton(folder_.write("a.xml", text));
  const Joint& ankle = skeleton.joints[1];
  EXPECT_EQ(ankle.mimics, "knee");
  EXPECT_EQ(ankle.follows, -2.0);
  const double knee = 0.5;  // 0.7 from the file's pose
  const auto poses = body_poses(skeleton, Eigen::Vector3d(0.0, ankle.follows * knee, knee));
  const double turned = 0.1 - 2.0 * 0.7;
  EXPECT_TRUE(poses[1].linear().isApprox(
      Eigen::AngleAxisd(turned, Eigen::Vector3d::UnitY()).toRotationMatrix(), 1e-12));
  EXPECT_TRUE(
      poses[2].linear().isApprox(Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitY()).toRotationMatrix(), 1e-12));
}

TEST_F(LoopFiles, MjcfHoldsAJointThatNoOtherGives) {
  const std::string text = changed(kMjcf, "LOOP", R"(<joint joint1="ankle" polycoef="0.25 0 0 0 0"/>)");
  const Skeleton skeleton = read_skeleton(folder_.write("a.xml", text));
  EXPECT_EQ(skeleton.joints[1].type, JointType::fixed);
  const auto poses = body_poses(skeleton, Eigen::Vector2d::Zero());
  EXPECT_TRUE(poses[1].linear().isApprox(Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitY()).toRotationMatrix(),
                                         1e-12));
}

// The same leg with the pin as a joint of the skeleton.
TEST_F(LoopFiles, SdfJointsToALinkThatHasOneCloseLoops) {
  for (const auto& [type, rows] : {std::pair<std::string, int>{"revolute", 2}, {"ball", 2}}) {
    const std::string pin = "<joint name=\"pin\" type=\"" + type +
                            "\"><pose relative_to=\"coupler\">0.28 0 0 0 0 0</pose><parent>coupler</parent>"
                            "<child>shin</child>" +
                            (type == "revolute" ? "<axis><xyz>0 1 0</xyz></axis>" : "") + "</joint></model>";
    std::string sdf = changed(text_of("four_bar.sdf"), "</model>", pin);
    sdf = changed(sdf, "<pose>0.3 0 0 0 0 0</pose>", "<pose>0.36 0 0.12 0 0 0</pose>");
    Model model;
    model.skeleton = read_skeleton(folder_.write("closed.sdf", sdf));
    ASSERT_EQ(model.skeleton.loops.size(), 1U);
    EXPECT_EQ(model.skeleton.joints.size(), 3U);
    model.loops = model.skeleton.loops;
    Plant plant(model, {});
    EXPECT_EQ(plant.closure()->size(), rows);
    EXPECT_LT(plant.home().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace plumbline::model
