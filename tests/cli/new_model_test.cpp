// `plumbline new-model`: from a skeleton and a log to a model and trials that the other commands take.
#include <gmock/gmock.h>

#include <cmath>
#include <sstream>

#include "tests/cli/robot_folder.h"

namespace plumbline::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

class NewModel : public RobotFolder {
 protected:
  void SetUp() override {
    RobotFolder::SetUp();
    write(
        "arm.urdf",
        "<robot name=\"arm\"><link name=\"base\"/>\n"
        "<link name=\"bar\"><inertial><origin xyz=\"0 0 -0.25\"/><mass value=\"2\"/>\n"
        "<inertia ixx=\"0.05\" iyy=\"0.05\" izz=\"0.001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n"
        "<joint name=\"swing\" type=\"revolute\"><parent link=\"base\"/><child link=\"bar\"/>\n"
        "<origin xyz=\"0 0 0\"/><axis xyz=\"0 1 0\"/><limit lower=\"-3\" upper=\"3\" effort=\"9\" "
        "velocity=\"9\"/></joint></robot>\n");
    write("log.csv", log("i_swing [A]"));
  }

  /// A swing of 0.4 rad at 0.8 Hz, held against gravity and inertia of the bar by a motor of kTorqueConstant.
  static std::string log(const std::string& command) {
    std::ostringstream text;
    text.precision(10);
    text << "t [s],q_swing [rad]," << command << ",temperature [1]\n";
    for (int i = 0; i < 1000; ++i) {
      const double t = 0.005 * i;
      const double rate = 2.0 * 3.14159265358979 * 0.8;
      const double q = 0.4 * std::sin(rate * t);
      const double force = (0.05 + 2.0 * 0.25 * 0.25) * -rate * rate * q + 2.0 * 9.80665 * 0.25 * std::sin(q);
      text << t << ',' << q << ',' << force / kTorqueConstant << ",20\n";
    }
    return text.str();
  }

  static constexpr double kTorqueConstant = 4.0;  // N m/A
};

TEST_F(NewModel, FindsColumnsUnitsAndTheTorqueConstant) {
  succeed({"new-model", "arm.urdf", "--from", "log.csv", "--out", "model.yaml", "--json", "made.json"});
  const json joint = read_json("made.json")["joints"].at(0);
  EXPECT_EQ(joint["position"], "q_swing");
  EXPECT_EQ(joint["command"], "i_swing");
  EXPECT_NEAR(joint["torque_constant"].get<double>(), kTorqueConstant, 0.03 * kTorqueConstant);
}

TEST_F(NewModel, IsReadByTheOtherCommands) {
  succeed({"new-model", "arm.urdf", "--from", "log.csv", "--out", "model.yaml"});
  succeed({"check", "model.yaml"});
  succeed({"compare", "log_train", "log_held_out", "--json", "compared.json"});
  EXPECT_GT(read_json("compared.json")["held_out"].get<double>(), 0.0);
}

// An arm with a gripper whose second finger mimics the first, and a log of the arm alone.
TEST_F(NewModel, TakesAGripperThatTheLogDoesNotShow) {
  std::string arm = read("arm.urdf");
  const std::string finger =
      "\"><inertial><mass value=\"0.1\"/><inertia ixx=\"1e-5\" iyy=\"1e-5\" izz=\"1e-5\" ixy=\"0\" ixz=\"0\" "
      "iyz=\"0\"/></inertial></link>\n<joint type=\"prismatic\" name=\"slide_";
  const std::string on = "\"><parent link=\"bar\"/><child link=\"";
  const std::string limit =
      "\"/><origin xyz=\"0 0 -0.5\"/><limit lower=\"0\" upper=\"0.04\" effort=\"9\" velocity=\"9\"/><axis "
      "xyz=\"0 ";
  arm.insert(arm.find("</robot>"), "<link name=\"left" + finger + "left" + on + "left" + limit +
                                       "1 0\"/></joint>\n<link name=\"right" + finger + "right" + on +
                                       "right" + limit + "-1 0\"/><mimic joint=\"slide_left\"/></joint>");
  write("gripper.urdf", arm);
  const std::string out =
      succeed({"new-model", "gripper.urdf", "--from", "log.csv", "--out", "model.yaml"}).out;
  EXPECT_THAT(out, HasSubstr("Joint slide_left: the log has no column of it"));
  EXPECT_THAT(read("log_train/trial.yaml"), HasSubstr("locked:\n  slide_left: {value: 0, unit: m}"));
  succeed({"compare", "log_train", "log_held_out"});
}

// No joint leads to the root link: it is fixed to the world, or floats when that is asked for.
TEST_F(NewModel, LetsARootLinkFloat) {
  std::string arm = read("arm.urdf");
  arm.replace(arm.find("<link name=\"base\"/>"), 19,
              "<link name=\"base\"><inertial><mass value=\"4\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\" "
              "ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>");
  write("floating.urdf", arm);
  succeed({"new-model", "floating.urdf", "--floating-base", "--out", "model.yaml"});
  EXPECT_THAT(read("model.yaml"), HasSubstr("floating_base: true"));
  EXPECT_THAT(succeed({"check", "model.yaml"}).out, HasSubstr("7 independent coordinates"));
  arm.insert(arm.find("<link"),
             "<link name=\"world\"/><joint name=\"rail\" type=\"prismatic\"><parent link=\"world\"/><child "
             "link=\"base\"/><limit effort=\"9\" velocity=\"9\"/></joint>");
  write("hung.urdf", arm);
  const auto refused = plumbline({"new-model", "hung.urdf", "--floating-base", "--out", "hung.yaml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("one root link that no joint leads to"));
}

// A hip with a geared motor, a knee with a servo, an ankle that nothing drives.
TEST_F(NewModel, TakesTheActuatorsAndTheNoiseOfAnMjcfFile) {
  write(
      "leg.xml",
      "<mujoco><compiler angle=\"radian\"/><default><position forcerange=\"-30 30\" kp=\"80\"/></default>\n"
      "<worldbody><body name=\"thigh\"><joint name=\"hip\" axis=\"0 1 0\"/><geom size=\"0.05\" mass=\"2\"/>\n"
      "<body name=\"shin\" pos=\"0 0 -0.3\"><joint name=\"knee\" axis=\"0 1 0\"/><geom size=\"0.04\" "
      "mass=\"1\"/>\n"
      "<body name=\"foot\" pos=\"0 0 -0.3\"><joint name=\"ankle\" axis=\"0 1 0\"/><geom size=\"0.02\" "
      "mass=\"0.2\"/></body></body></body></worldbody>\n"
      "<actuator><motor name=\"hip_drive\" joint=\"hip\" gear=\"10\" ctrlrange=\"-2 2\"/>\n"
      "<position joint=\"knee\" gear=\"2\"/></actuator>\n"
      "<sensor><jointpos joint=\"knee\" noise=\"0.002\"/></sensor></mujoco>\n");
  succeed({"new-model", "leg.xml", "--out", "model.yaml"});
  const std::string made = read("model.yaml");
  EXPECT_THAT(
      made,
      HasSubstr("torque_limit: {value: 20, unit: N m, source: \"leg.xml: range of <motor> hip_drive\"}"));
  EXPECT_THAT(made, HasSubstr("<position>, a servo of 160 N m/rad and 0 N m s/rad"));
  EXPECT_THAT(made,
              HasSubstr("torque_limit: {value: 60, unit: N m, source: \"leg.xml: range of <position>\"}"));
  EXPECT_THAT(made,
              HasSubstr("noise: {value: 0.002, unit: rad, source: \"leg.xml: noise of its <jointpos>\"}"));
  EXPECT_THAT(made, testing::Not(HasSubstr("ankle_motor")));
  EXPECT_THAT(made, testing::Not(HasSubstr("<actuator>")));
  succeed({"check", "model.yaml"});
}

// A pendulum that hangs on a free pivot: the file's transmissions say which joint is driven, the log has no
// command of the other, and both joints have "joint" within their names.
class FreePivot : public NewModel {
 protected:
  void SetUp() override {
    NewModel::SetUp();
    std::string arm = read("arm.urdf");
    arm.replace(arm.find("\"swing\""), 7, "\"upper_joint_1\"");
    arm.insert(
        arm.find("</robot>"),
        "<link name=\"tip\"><inertial><origin xyz=\"0 0 -0.1\"/><mass value=\"1\"/><inertia ixx=\"0.01\" "
        "iyy=\"0.01\" izz=\"0.001\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n"
        "<joint name=\"lower_joint_2\" type=\"continuous\"><parent link=\"bar\"/><child link=\"tip\"/>\n"
        "<origin xyz=\"0 0 -0.5\"/><axis xyz=\"0 1 0\"/></joint>");
    write("plain.urdf", arm);
    arm.insert(arm.find("</robot>"),
               "<transmission name=\"drive\"><joint name=\"lower_joint_2\"/></transmission>");
    write("free.urdf", arm);
    std::ostringstream text;
    text << "t [s],upper_joint_1_pos [rad],lower_joint_2_pos [rad],lower_joint_2_torque [N m]\n";
    for (int i = 0; i < 500; ++i) {
      text << 0.01 * i << ',' << 0.1 * std::sin(0.05 * i) << ',' << 0.2 * std::sin(0.04 * i) << ','
           << 0.3 * std::cos(0.04 * i) << '\n';
    }
    write("free.csv", text.str());
  }
};

TEST_F(FreePivot, HasNoMotorWhereTheFileHasNoTransmission) {
  succeed({"new-model", "free.urdf", "--out", "model.yaml"});
  EXPECT_THAT(read("model.yaml"), HasSubstr("lower_joint_2_motor"));
  EXPECT_THAT(read("model.yaml"), testing::Not(HasSubstr("upper_joint_1_motor")));
}

TEST_F(FreePivot, HasNoMotorWhereTheLogHasNoCommand) {
  const Outcome made = succeed({"new-model", "plain.urdf", "--from", "free.csv", "--out", "model.yaml"});
  EXPECT_THAT(made.out, HasSubstr("Joint upper_joint_1: neither the file nor the log has a drive of it"));
  EXPECT_THAT(read("model.yaml"), testing::Not(HasSubstr("upper_joint_1_motor")));
  EXPECT_THAT(read("free_train/trial.yaml"), HasSubstr("upper_joint_1: {column: \"upper_joint_1_pos\""));
  succeed({"compare", "free_train", "free_held_out"});
}

TEST_F(NewModel, SaysWhichJointAnActuatorMisses) {
  write("leg.xml",
        "<mujoco><worldbody><body><joint name=\"hip\"/><geom size=\"0.05\"/></body></worldbody>\n"
        "<actuator><motor joint=\"hop\"/></actuator></mujoco>\n");
  const Outcome refused = plumbline({"new-model", "leg.xml", "--out", "model.yaml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err,
              HasSubstr("leg.xml:2: motor: found joint \"hop\", expected the name of a joint of the file"));
}

TEST_F(NewModel, NeedsNoLog) {
  succeed({"new-model", "arm.urdf", "--out", "model.yaml"});
  EXPECT_THAT(read("model.yaml"), HasSubstr("command_unit: N m"));
  succeed({"check", "model.yaml"});
}

TEST_F(NewModel, SaysWhichColumnBelongsToNoJoint) {
  const Outcome made = succeed({"new-model", "arm.urdf", "--from", "log.csv", "--out", "model.yaml"});
  EXPECT_THAT(made.out, HasSubstr("Column temperature: belongs to no joint"));
}

TEST_F(NewModel, OverwritesNothingAndLeavesNothingBehind) {
  write("model.yaml", "mine\n");
  const auto before = snapshot();
  const Outcome refused = plumbline({"new-model", "arm.urdf", "--from", "log.csv", "--out", "model.yaml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("model.yaml"));
  EXPECT_TRUE(changed_since(before).empty());
}

TEST_F(NewModel, RefusesALogWithoutAColumnOfAJoint) {
  write("other.csv", "t [s],temperature [1]\n0,20\n0.01,20\n0.02,20\n");
  const auto before = snapshot();
  const Outcome refused = plumbline({"new-model", "arm.urdf", "--from", "other.csv", "--out", "model.yaml"});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("other.csv"));
  EXPECT_TRUE(changed_since(before).empty());
}

}  // namespace
}  // namespace plumbline::test
