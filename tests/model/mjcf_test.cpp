// MJCF skeletons against MuJoCo's own compiler, where it is installed, and against closed forms.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simulator/model/mjcf_file.h"
#include "simulator/model/plant.h"
#include "simulator/model/rigid_part.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

#ifdef PLUMBLINE_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

namespace plumbline::model {
namespace {

using testing::HasSubstr;

/// A hip of two hinges on a slide, a shin of geoms, a foot that is fixed, with classes and all sorts of
/// poses.
constexpr const char* kLeg = R"(<mujoco model="leg">
  <compiler angle="degree" eulerseq="XYZ" autolimits="true"/>
  <option gravity="0 0.5 -9.7"/>
  <default>
    <joint damping="0.2"/>
    <geom density="2700"/>
    <default class="knee"><joint damping="0.4" frictionloss="0.3" armature="0.02"/></default>
  </default>
  <worldbody>
    <geom type="plane" size="1 1 1"/>
    <body name="carriage" pos="0.1 0 1.2" euler="10 20 30">
      <joint name="rail" type="slide" axis="1 0 0.2" damping="5" ref="0.1"/>
      <inertial pos="0.01 0.02 0.03" quat="0.9 0.1 0.3 0.2" mass="3" diaginertia="0.02 0.03 0.04"/>
      <body name="thigh" pos="0 0.1 0" axisangle="0 1 1 35">
        <joint name="abduction" axis="1 0 0" pos="0 0 0.05"/>
        <joint name="hip" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.1 0 -0.4" size="0.03"/>
        <geom type="box" size="0.02 0.03 0.05" pos="0.02 0 -0.1" xyaxes="0 1 0 -1 0.3 0" mass="0.7"/>
        <body name="shin" pos="0.1 0 -0.4" childclass="knee">
          <joint name="knee" axis="0 1 0" pos="0 0 0.01" ref="20" stiffness="6" springref="10" limited="true" range="0 120"/>
          <geom type="cylinder" size="0.02 0.2" pos="0 0 -0.2" zaxis="0 0.2 1"/>
          <geom type="ellipsoid" size="0.03 0.02 0.04" pos="0 0 -0.35" density="500"/>
          <body name="foot" pos="0 0 -0.4">
            <inertial pos="0 0 0" mass="0.2" fullinertia="0.001 0.0012 0.0009 0.0001 -0.0002 0.00005"/>
            <geom type="sphere" size="0.05"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="knee"/><motor joint="hip"/></actuator>
</mujoco>
)";

const Joint& joint_named(const Skeleton& skeleton, const std::string& name) {
  for (const Joint& joint : skeleton.joints) {
    if (joint.name == name) {
      return joint;
    }
  }
  throw std::runtime_error("no joint " + name);
}

class Mjcf : public testing::Test {
 protected:
  Skeleton read(const std::string& text) { return read_mjcf(folder_.write("leg.xml", text)); }
  std::string refusal(const std::string& what, const std::string& by) {
    std::string text = kLeg;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    text.replace(at, what.size(), by);
    return test::refusal([&] { read(text); });
  }
  test::TemporaryFolder folder_;
};

TEST_F(Mjcf, BodiesJointsAndWhatIsLeftOut) {
  const Skeleton leg = read(kLeg);
  ASSERT_EQ(leg.bodies.size(), 5U);  // the thigh's first hinge carries a body without mass
  EXPECT_EQ(leg.bodies[1].name, "thigh_of_abduction");
  EXPECT_EQ(leg.bodies[1].mass, 0.0);
  EXPECT_EQ(leg.gravity, Eigen::Vector3d(0, 0.5, -9.7));
  EXPECT_EQ(joint_named(leg, "rail").damping, 5.0);
  EXPECT_EQ(joint_named(leg, "hip").damping, 0.2);
  EXPECT_EQ(joint_named(leg, "hip").friction, 0.0);
  EXPECT_EQ(joint_named(leg, "knee").damping, 0.4);
  EXPECT_EQ(joint_named(leg, "knee").friction, 0.3);
  EXPECT_EQ(joint_named(leg, "knee").armature, 0.02);
  EXPECT_EQ(joint_named(leg, "fix_foot").type, JointType::fixed);
  EXPECT_THAT(leg.left_out, testing::Contains(HasSubstr("<actuator> with 2 elements")));
  EXPECT_THAT(leg.left_out, testing::Contains(HasSubstr("ranges of 1 joints")));
  EXPECT_NEAR(joint_named(leg, "knee").reference, M_PI / 9.0, 1e-15);
  EXPECT_EQ(joint_named(leg, "knee").stiffness, 6.0);
  EXPECT_NEAR(joint_named(leg, "knee").rest, M_PI / 18.0, 1e-15);
}

// A capsule lies on the ground with its ends: spheres about the ends of its axis.
TEST_F(Mjcf, CapsulesAreTheirEnds) {
  const Skeleton leg = read(kLeg);
  ASSERT_EQ(leg.spheres.size(), 3U);  // of the foot one, of the thigh's capsule two
  EXPECT_EQ(leg.spheres[0].shape, "thigh_capsule");
  EXPECT_EQ(leg.spheres[0].radius, 0.03);
  EXPECT_LT((leg.spheres[0].centre - Eigen::Vector3d(0.1, 0.0, -0.4)).norm(), 1e-14);
  EXPECT_LT(leg.spheres[1].centre.norm(), 1e-14);
  EXPECT_TRUE(leg.spheres[2].shape.empty());
  folder_.write("leg.xml", kLeg);
  const std::string text = "plumbline: model/1\nrobot: leg\nskeleton: leg.xml\nfeet: ";
  const Model model = read_model(folder_.write("model.yaml", text + "{side: {capsule: thigh_capsule}}\n"),
                                 effects::Catalogue::all());
  ASSERT_EQ(model.feet.size(), 2U);
  EXPECT_EQ(model.feet[1].name, "side_2");
  EXPECT_EQ(model.feet[1].group, "side");
  EXPECT_EQ(model.body_index("thigh"), model.feet[1].body);
  const std::string refusal = test::refusal([&] {
    read_model(folder_.write("bad.yaml", text + "{side: {capsule: thigh_capsul}}\n"),
               effects::Catalogue::all());
  });
  EXPECT_THAT(refusal, HasSubstr("bad.yaml:4: feet.side.capsule: found \"thigh_capsul\""));
}

// A capsule is a cylinder and a sphere: in the limits of no radius and no length it becomes them.
TEST(MjcfShapes, ClosedForms) {
  const RigidPart rod = *solid("capsule", {1e-4, 0.5});
  EXPECT_NEAR(rod.inertia(0, 0) / rod.mass, 1.0 / 12.0, 1e-4);
  const RigidPart ball = *solid("capsule", {0.1, 1e-9});
  EXPECT_NEAR(ball.inertia(0, 0) / ball.mass, 0.4 * 0.01, 1e-9);
  EXPECT_NEAR(ball.inertia(2, 2) / ball.mass, 0.4 * 0.01, 1e-9);
  const RigidPart cube = *solid("box", {0.5, 0.5, 0.5});
  EXPECT_NEAR(cube.mass, 1.0, 1e-15);
  EXPECT_NEAR(cube.inertia(1, 1), 1.0 / 6.0, 1e-15);
  EXPECT_FALSE(solid("box", {0.5, 0.5}).has_value());
  EXPECT_FALSE(solid("sphere", {0.0}).has_value());
}

#ifdef PLUMBLINE_HAS_MUJOCO
/// MuJoCo compiles the same file: its mass matrix and bias forces of random states are the plant's.
TEST_F(Mjcf, MovesAsMujocoDoes) {
  std::string text = kLeg;
  const std::string path = folder_.write("leg.xml", text);
  const std::string model_file = folder_.write("model.yaml", R"(plumbline: model/1
robot: leg
skeleton: leg.xml
coordinates: {rail: {of: {rail: 1}}, abduction: {of: {abduction: 1}}, hip: {of: {hip: 1}}, knee: {of: {knee: 1}}}
joint_dynamics: take
)");
  const Model model = read_model(model_file, effects::Catalogue::all());
  Plant plant(model, {});
  ASSERT_EQ(plant.positions(), 4);
  char error[500] = "";
  mjModel* m = mj_loadXML(path.c_str(), nullptr, error, sizeof error);
  ASSERT_NE(m, nullptr) << error;
  m->opt.disableflags |= mjDSBL_CONTACT | mjDSBL_LIMIT | mjDSBL_FRICTIONLOSS;
  mjData* d = mj_makeData(m);
  std::srand(3);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::VectorXd z = Eigen::VectorXd::Random(4);
    const Eigen::VectorXd v = Eigen::VectorXd::Random(4);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x << z, v;
    for (int i = 0; i < 4; ++i) {
      d->qpos[i] = z[i];
      d->qvel[i] = v[i];
    }
    mj_forward(m, d);
    // Without the dry friction, which MuJoCo has as a constraint: its torque is taken off by hand.
    Eigen::VectorXd rate(plant.states());
    plant.rate(x.data(), nullptr, rate.data());
    Eigen::MatrixXd M(4, 4);
    mj_fullM(m, M.data(), d->qM);
    EXPECT_LT((plant.mass_matrix() - M).cwiseAbs().maxCoeff(), 1e-9) << "state " << trial;
    Eigen::VectorXd friction = Eigen::VectorXd::Zero(4);
    const auto dry = std::find_if(model.effects.begin(), model.effects.end(), [](const EffectUse& use) {
      return use.law->declaration().name == "coulomb";
    });
    ASSERT_NE(dry, model.effects.end());
    const EffectUse& coulomb = *dry;
    friction[3] = -0.3 * std::tanh(v[3] / coulomb.values[1].value);
    const Eigen::VectorXd theirs =
        Eigen::Map<const Eigen::VectorXd>(d->qacc_smooth, 4) + M.ldlt().solve(friction);
    EXPECT_LT((rate.segment(4, 4) - theirs).cwiseAbs().maxCoeff(),
              1e-7 * (1.0 + theirs.cwiseAbs().maxCoeff()))
        << "state " << trial;
  }
  mj_deleteData(d);
  mj_deleteModel(m);
}
#endif

TEST_F(Mjcf, BadFilesAreRefusedInOneLine) {
  EXPECT_THAT(refusal(R"(type="slide")", R"(type="screw")"),
              HasSubstr("leg.xml:12: rail: found a joint of type screw"));
  EXPECT_THAT(refusal(R"(<joint name="hip" axis="0 1 0"/>)", "<freejoint/>"),
              HasSubstr("leg.xml:16: freejoint: found a free joint of a body inside another"));
  EXPECT_THAT(refusal(R"(axis="1 0 0.2")", R"(axis="0 0 0")"), HasSubstr("an axis of zeros"));
  EXPECT_THAT(refusal(R"(axis="1 0 0.2")", R"(axis="1 0")"), HasSubstr("expected three numbers"));
  EXPECT_THAT(refusal(R"(axis="1 0 0.2")", R"(axis="1 0 x")"), HasSubstr("expected numbers"));
  EXPECT_THAT(refusal(R"(diaginertia="0.02 0.03 0.04")", R"(diaginertia="0.02 0.03 0.4")"),
              HasSubstr("none larger than the sum"));
  EXPECT_THAT(refusal(R"(mass="3")", R"(mass="-3")"), HasSubstr("a mass of -3 kg"));
  EXPECT_THAT(refusal(R"(childclass="knee")", R"(childclass="ankle")"), HasSubstr("childclass \"ankle\""));
  EXPECT_THAT(refusal(R"(damping="5")", R"(damping="-5")"), HasSubstr("damping -5"));
  EXPECT_THAT(refusal(R"(name="hip")", R"(name="rail")"), HasSubstr("this name twice"));
  EXPECT_THAT(refusal(R"(type="capsule")", R"(type="mesh" mesh="a")"), HasSubstr("mesh \"a\""));
  EXPECT_THAT(refusal("<worldbody>", "<worldbody><include file='a.xml'/>"),
              HasSubstr("leg.xml:9: include: found no file \"a.xml\""));
  EXPECT_THAT(refusal("</mujoco>", ""), HasSubstr("no XML"));
  EXPECT_THAT(refusal(R"(0.1 0 -0.4" size="0.03")", R"(0.1 0 -0.4" size="0")"),
              HasSubstr("a geom of type capsule with 2 sizes"));
}

}  // namespace
}  // namespace plumbline::model
