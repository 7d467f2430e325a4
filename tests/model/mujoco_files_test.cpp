// Sensors at points of links, and foreign robots' files as they are, beside MuJoCo.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/mjcf_file.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/rotation_vector.h"
#include "simulator/trace/number_text.h"
#include "tests/model/mujoco_peer.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using Eigen::Vector3d;

constexpr const char* kArm = R"(<mujoco model="arm">
  <compiler angle="radian" eulerseq="XYZ"/>
  <option gravity="0.3 -0.2 -9.81"/>
  <worldbody>
    <body name="trunk" pos="0 0 0.4">
      <freejoint/>
      <inertial pos="0.02 0.01 -0.005" quat="0.7 0.1 0.2 0.7" mass="6.9" diaginertia="0.107 0.098 0.0244"/>
      <site name="imu" pos="0.1 -0.05 0.03" euler="0.2 -0.4 1.1"/>
      <body name="thigh" pos="0.19 0.05 0">
        <inertial pos="0 -0.02 -0.03" mass="1.1" diaginertia="0.006 0.0058 0.0009"/>
        <joint name="hip" axis="0 1 0"/>
        <body name="calf" pos="0 0 -0.21">
          <inertial pos="0.006 0 -0.14" mass="0.24" diaginertia="0.0015 0.0014 0.0005"/>
          <joint name="knee" axis="1 1 0" damping="0.1" stiffness="3" springref="0.2"/>
          <site name="skin" pos="0.02 0 -0.2"/>
        </body>
      </body>
    </body>
  </worldbody>
  <sensor>
    <framepos objtype="site" objname="skin"/>
    <framequat objtype="site" objname="imu"/>
    <gyro site="imu"/>
    <accelerometer site="imu"/>
    <accelerometer site="skin"/>
  </sensor>
</mujoco>
)";

constexpr const char* kSensors = R"(plumbline: model/1
robot: arm
skeleton: arm.xml
coordinates: {knee: {of: {knee: 1}}}
joint_dynamics: take
sensors:
  skin: {marker: calf, at: {value: [20, 0, -200], unit: mm}, noise: {value: 1, unit: mm}, assumed: test}
  turn: {orientation: trunk, turn: {value: [0.2, -0.4, 1.1], unit: rad}, noise: {value: 1, unit: mrad}, assumed: test}
  gyro: {gyroscope: trunk, turn: {value: [0.2, -0.4, 1.1], unit: rad}, noise: {value: 0.01, unit: rad/s}, assumed: test}
  acc:
    accelerometer: trunk
    at: {value: [0.1, -0.05, 0.03], unit: m}
    turn: {value: [0.2, -0.4, 1.1], unit: rad}
    noise: {value: 0.1, unit: m/s^2}
    assumed: test
  skin_acc: {accelerometer: calf, at: {value: [0.02, 0, -0.2], unit: m}, noise: {value: 0.1, unit: m/s^2}, assumed: test}
)";

class BesideMujoco : public testing::Test {
 protected:
  test::TemporaryFolder folder_;
};

TEST_F(BesideMujoco, SensorsReadTheSame) {
  const std::string file = folder_.write("arm.xml", kArm);
  const Model model = read_model(folder_.write("model.yaml", kSensors), known_effects());
  Plant plant(model, {});
  const test::Mujoco mujoco(file);
  const int n = plant.positions();
  ASSERT_EQ(n, mujoco.m->nv);
  std::srand(8);
  for (int trial = 0; trial < 100; ++trial) {
    Eigen::VectorXd x(2 * n);
    x << 1.3 * Eigen::VectorXd::Random(n), 3.0 * Eigen::VectorXd::Random(n);
    Eigen::VectorXd y(plant.sensors());
    plant.outputs(x.data(), y.data());
    test::set_state(mujoco, x.head(n), x.tail(n));
    mj_forward(mujoco.m, mujoco.d);
    const double* s = mujoco.d->sensordata;
    const auto reading = [&](const char* name) { return y.segment<3>(model.sensor_index(name)).eval(); };
    EXPECT_LT((reading("skin_x") - Vector3d(s[0], s[1], s[2])).norm(), 1e-12) << trial;
    const Eigen::Matrix3d R = Eigen::Quaterniond(s[3], s[4], s[5], s[6]).toRotationMatrix();
    EXPECT_LT((rotation_of(reading("turn_x")) - R).norm(), 1e-12) << trial;
    EXPECT_LT((reading("gyro_x") - Vector3d(s[7], s[8], s[9])).norm(), 1e-11) << trial;
    EXPECT_LT((reading("acc_x") - Vector3d(s[10], s[11], s[12])).norm(), 1e-9) << trial;
    EXPECT_LT((reading("skin_acc_x") - Vector3d(s[13], s[14], s[15])).norm(), 1e-9) << trial;
  }
}

struct Worst {
  double mass = 0.0, energy = 0.0, acceleration = 0.0;
};

/// In 100 random states, relative. On both sides: dampings, springs and armatures of hinges and slides. Left
/// out on both: contact, limits, dry friction, loops, and what ball joints state of damping.
Worst compare(const test::TemporaryFolder& folder, const std::string& file) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.LoadFile(file.c_str()), tinyxml2::XML_SUCCESS) << file;
  test::take_away_meshes(*document.RootElement());
  const std::string bare = folder.write("robot.xml", "");
  document.SaveFile(bare.c_str());
  const Skeleton skeleton = read_mjcf(bare);
  std::string text =
      "plumbline: model/1\nrobot: r\nskeleton: robot.xml\njoint_dynamics: take\ncoordinates:\n";
  int coordinates = 0;
  for (const Joint& joint : skeleton.joints) {
    if (joint.type != JointType::fixed) {
      text += "  c" + std::to_string(++coordinates) + ": {of: {\"" + joint.name + "\": 1}}\n";
    }
  }
  Model model = read_model(folder.write("model.yaml", text), known_effects());
  const auto is_dry = [](const EffectUse& use) { return use.law->declaration().name == "coulomb"; };
  model.effects.erase(std::remove_if(model.effects.begin(), model.effects.end(), is_dry),
                      model.effects.end());
  model.loops.clear();
  Plant plant(model, {});
  const test::Mujoco mujoco(bare);
  for (int j = 0; j < mujoco.m->njnt; ++j) {
    for (int i = 0; mujoco.m->jnt_type[j] == mjJNT_BALL && i < 3; ++i) {
      mujoco.m->dof_damping[mujoco.m->jnt_dofadr[j] + i] = 0.0;
    }
  }
  const int n = plant.positions();
  EXPECT_EQ(n, mujoco.m->nv) << file;
  Worst worst;
  for (const Body& body : model.skeleton.bodies) {
    worst.mass += body.mass;
  }
  worst.mass = std::abs(worst.mass - mj_getTotalmass(mujoco.m));
  std::srand(5);
  for (int trial = 0; trial < 100 && n == mujoco.m->nv; ++trial) {
    Eigen::VectorXd x(2 * n), rate(2 * n);
    x << 1.3 * Eigen::VectorXd::Random(n), 2.0 * Eigen::VectorXd::Random(n);
    plant.rate(x.data(), nullptr, rate.data());
    test::set_state(mujoco, x.head(n), x.tail(n));
    mj_forward(mujoco.m, mujoco.d);
    const Eigen::VectorXd ours = test::accelerations(mujoco, x.head(n), x.tail(n), rate.tail(n));
    const Eigen::Map<const Eigen::VectorXd> theirs(mujoco.d->qacc, n);
    worst.acceleration = std::max(
        worst.acceleration, (ours - theirs).cwiseAbs().maxCoeff() / (1.0 + theirs.cwiseAbs().maxCoeff()));
    const double energy = mujoco.d->energy[0] + mujoco.d->energy[1];
    worst.energy = std::max(worst.energy, std::abs(plant.energetics(x.data(), nullptr).stored - energy) /
                                              (1.0 + std::abs(energy)));
  }
  return worst;
}

/// PLUMBLINE_MENAGERIE names the folder of mujoco_menagerie: no copy of a foreign model is kept here.
TEST_F(BesideMujoco, ForeignRobotsMoveTheSame) {
  const char* menagerie = std::getenv("PLUMBLINE_MENAGERIE");
  if (menagerie == nullptr) {
    GTEST_SKIP() << "PLUMBLINE_MENAGERIE is not set";
  }
  int found = 0;
  for (const char* robot :
       {"unitree_go2/go2", "unitree_go1/go1", "unitree_a1/a1", "anybotics_anymal_b/anymal_b",
        "anybotics_anymal_c/anymal_c", "agility_cassie/cassie"}) {
    const std::string file = std::string(menagerie) + "/" + robot + ".xml";
    if (!std::filesystem::exists(file)) {
      continue;
    }
    ++found;
    const Worst worst = compare(folder_, file);
    std::printf("%-28s mass %.1e kg, energy %.1e, accelerations %.1e (relative)\n", robot, worst.mass,
                worst.energy, worst.acceleration);
    EXPECT_LT(worst.mass, 1e-12) << robot;
    // MuJoCo turns a `fullinertia` onto its principal axes by a search that ends at 1e-6 of it or so (A1:
    // 4e-9, Cassie: 1e-6): that is what these two differ by.
    const bool searched =
        robot == std::string("unitree_a1/a1") || robot == std::string("agility_cassie/cassie");
    EXPECT_LT(worst.energy, searched ? 1e-9 : 1e-11) << robot;
    EXPECT_LT(worst.acceleration, searched ? 1e-8 : 1e-9) << robot;
  }
  EXPECT_GT(found, 0) << "no robot in " << menagerie;
}

}  // namespace
}  // namespace plumbline::model
