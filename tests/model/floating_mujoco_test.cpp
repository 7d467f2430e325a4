// A floating robot with hinges, a slide and a ball joint beside MuJoCo, which holds orientations as
// quaternions.
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/number_text.h"
#include "tests/model/mujoco_peer.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

constexpr const char* kDog = R"(<mujoco model="dog">
  <compiler angle="radian"/>
  <option gravity="0.3 -0.2 -9.81"/>
  <default><default class="leg"><joint axis="0 1 0" armature="0"/></default></default>
  <worldbody>
    <geom type="plane" size="5 5 0.1"/>
    <body name="trunk" pos="0 0 0.4" quat="0.9 0.1 0.2 0.1">
      <freejoint name="root"/>
      <inertial pos="0.02 0.01 -0.005" quat="0.7 0.1 0.2 0.7" mass="6.9" diaginertia="0.107 0.098 0.0244"/>
      <body name="hip" pos="0.19 0.05 0" childclass="leg">
        <inertial pos="0 0.02 0" mass="0.7" diaginertia="0.0009 0.0006 0.0005"/>
        <joint name="abduction" axis="1 0 0"/>
        <body name="thigh" pos="0 0.09 0">
          <inertial pos="0 -0.02 -0.03" quat="0.8 0.1 0 0.5" mass="1.1" diaginertia="0.006 0.0058 0.0009"/>
          <joint name="thigh" pos="0 0 0.01"/>
          <body name="calf" pos="0 0 -0.21">
            <inertial pos="0.006 0 -0.14" mass="0.24" diaginertia="0.0015 0.0014 0.0005"/>
            <joint name="calf" type="slide" axis="0 0.2 1"/>
            <geom name="toe" size="0.022" pos="0 0 -0.2"/>
          </body>
        </body>
      </body>
      <body name="tail" pos="-0.3 0 0.05" euler="0.3 -0.2 0.5">
        <joint name="wag" type="ball" pos="0.01 0 0.02"/>
        <inertial pos="-0.1 0.02 0.03" quat="0.9 0.2 0 0.1" mass="0.8" diaginertia="0.004 0.003 0.002"/>
      </body>
    </body>
  </worldbody>
</mujoco>
)";

/// PLUMBLINE_FLOATING_MJCF names another file: no copy of a foreign model is kept here.
class Floating : public testing::Test {
 protected:
  std::string path() {
    const char* other = std::getenv("PLUMBLINE_FLOATING_MJCF");
    return other != nullptr ? other : folder_.write("dog.xml", kDog);
  }
  test::TemporaryFolder folder_;
};

TEST_F(Floating, MovesAsMujocoDoes) {
  const std::string file = path();
  const Model model =
      read_model(folder_.write("model.yaml", "plumbline: model/1\nrobot: dog\nskeleton: " + file + "\n"),
                 known_effects());
  Plant plant(model, {});
  const test::Mujoco mujoco(file);
  mujoco.m->opt.disableflags |= mjDSBL_PASSIVE;
  const int n = plant.positions();
  ASSERT_EQ(n, mujoco.m->nv);
  for (int i = 0; i < n; ++i) {
    mujoco.m->dof_armature[i] = 0.0;  // rotors are the model file's
  }
  double mass = 0.0;
  for (const Body& body : model.skeleton.bodies) {
    mass += body.mass;
  }
  EXPECT_NEAR(mass, mj_getTotalmass(mujoco.m), 1e-12);
  std::srand(5);
  double worst = 0.0;
  double energy = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x.head(n) = 1.3 * Eigen::VectorXd::Random(n);
    x.segment(n, n) = 2.0 * Eigen::VectorXd::Random(n);
    Eigen::VectorXd rate(plant.states());
    plant.rate(x.data(), nullptr, rate.data());
    test::set_state(mujoco, x.head(n), x.segment(n, n));
    mj_forward(mujoco.m, mujoco.d);
    const Eigen::VectorXd ours = test::accelerations(mujoco, x.head(n), x.segment(n, n), rate.segment(n, n));
    const Eigen::Map<const Eigen::VectorXd> theirs(mujoco.d->qacc, n);
    worst = std::max(worst, (ours - theirs).cwiseAbs().maxCoeff() / (1.0 + theirs.cwiseAbs().maxCoeff()));
    const double theirs_energy = mujoco.d->energy[0] + mujoco.d->energy[1];
    energy = std::max(energy, std::abs(plant.energetics(x.data(), nullptr).stored - theirs_energy) /
                                  (1.0 + std::abs(theirs_energy)));
  }
  RecordProperty("worst_acceleration", number_text(worst, 3));
  RecordProperty("worst_energy", number_text(energy, 3));
  EXPECT_LT(worst, 1e-9);
  EXPECT_LT(energy, 1e-11);
}

}  // namespace
}  // namespace plumbline::model
