// Where links meet, beside MuJoCo's collision functions on the same file.
#include <gtest/gtest.h>

#include <array>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/model/mujoco_peer.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

/// Geoms within 1 m of each other are contacts there; of each pair one alone.
constexpr const char* kPairs = R"(<mujoco><worldbody>
  <body name="crate"><freejoint/>
    <geom name="box" type="box" size="0.2 0.15 0.1" mass="2" margin="0.5" contype="0" conaffinity="0"/>
    <geom name="rail" type="capsule" fromto="-0.1 0 0.2 0.1 0.03 0.2" size="0.02" mass="0.2" margin="0.5"/>
    <geom name="knob" size="0.03" pos="0 0.3 0" mass="0.1" margin="0.5"/>
  </body>
  <body name="arm"><freejoint/>
    <geom name="rod" type="capsule" fromto="0 0 0 0.2 0.05 0" size="0.03" mass="1" margin="0.5"/>
    <geom name="tip" size="0.04" pos="0.1 0.2 0.02" mass="0.5" margin="0.5"/>
  </body>
</worldbody><contact>
  <pair geom1="tip" geom2="box" margin="0.5"/>
</contact></mujoco>)";

/// The depth, point and normal of MuJoCo's contact of two geoms; the normal out of the second one.
struct Met {
  double depth = 0.0;
  Eigen::Vector3d point, normal;
  bool found = false;
};

Met met(const test::Mujoco& mujoco, const char* one, const char* other) {
  const int first = mj_name2id(mujoco.m, mjOBJ_GEOM, one);
  const int second = mj_name2id(mujoco.m, mjOBJ_GEOM, other);
  Met result;
  for (int c = 0; c < mujoco.d->ncon; ++c) {
    const mjContact& contact = mujoco.d->contact[c];
    const bool same = contact.geom1 == first && contact.geom2 == second;
    if (same || (contact.geom1 == second && contact.geom2 == first)) {
      result.found = true;
      result.depth = -contact.dist;
      result.point = Eigen::Vector3d(contact.pos[0], contact.pos[1], contact.pos[2]);
      result.normal =
          (same ? -1.0 : 1.0) * Eigen::Vector3d(contact.frame[0], contact.frame[1], contact.frame[2]);
    }
  }
  return result;
}

TEST(LinkContactsMujoco, MeetWhereMujocosGeomsMeet) {
  const test::TemporaryFolder folder;
  const std::string file = folder.write("pairs.xml", kPairs);
  const std::array<std::array<const char*, 2>, 5> pairs{
      {{"tip", "box"}, {"tip", "rail"}, {"tip", "knob"}, {"rod", "rail"}, {"rod", "knob"}}};
  const std::string crate = "{link: crate, value: [0, 0, 0], unit: m, box: [0.4, 0.3, 0.2]}";
  const auto end = [&](const std::string& geom) {
    return geom == "box" ? crate
                         : (geom == "rail" || geom == "rod" ? "{capsule: " : "{sphere: ") + geom + "}";
  };
  std::string text = "plumbline: model/1\nrobot: pairs\nskeleton: pairs.xml\ncontacts:\n";
  std::string laws = "effects:\n";
  for (const auto& [one, other] : pairs) {
    const std::string name = std::string(one) + "_" + other;
    text += "  " + name + ": {between: [" + end(one) + ", " + end(other) + "], assumed: test}\n";
    laws += "  - {effect: ground_normal, at: " + name +
            ", values: {stiffness: {value: 1, unit: N, assumed: t}}}\n";
  }
  Plant plant(read_model(folder.write("model.yaml", text + laws), known_effects()), {});
  const test::Mujoco mujoco(file);
  mujoco.m->opt.disableflags &= ~mjDSBL_CONTACT;
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> spread(-0.35, 0.35);
  std::array<int, 5> seen{};
  for (int trial = 0; trial < 400; ++trial) {
    const Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(plant.states(), [&]() { return spread(random); });
    const Eigen::Index n = plant.positions();
    test::set_state(mujoco, x.head(n), x.tail(n));
    mj_forward(mujoco.m, mujoco.d);
    const std::vector<LinkTouch> touches = plant.link_touches(x.data());
    ASSERT_EQ(touches.size(), pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const Met theirs = met(mujoco, pairs[k][0], pairs[k][1]);
      const bool inside = k == 0 && touches[k].depth > 0.04;  // where theirs gives the radius as depth
      if (!theirs.found || inside) {
        continue;
      }
      ++seen[k];
      EXPECT_NEAR(touches[k].depth, theirs.depth, 1e-9) << pairs[k][0] << " " << pairs[k][1];
      EXPECT_LT((touches[k].position - theirs.point).norm(), 1e-9) << pairs[k][0] << " " << pairs[k][1];
      EXPECT_LT((touches[k].normal() - theirs.normal).norm(), 1e-9) << pairs[k][0] << " " << pairs[k][1];
    }
  }
  for (const int count : seen) {
    EXPECT_GT(count, 100);
  }
}

}  // namespace
}  // namespace plumbline::model
