// What is drawn for a robot with shapes, without shapes, and with a mesh that cannot be used.
#include "simulator/render/figure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "simulator/mesh/mesh_mass.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::render {
namespace {

std::size_t parts_of(const Figure& figure, int body) {
  return static_cast<std::size_t>(std::count_if(figure.parts.begin(), figure.parts.end(),
                                                [&](const Part& part) { return part.body == body; }));
}

class FigureTest : public testing::Test {
 protected:
  const model::Model mabel_ =
      model::read_model(PLUMBLINE_ROOT "/robots/mabel/mabel.yaml", model::known_effects());
};

TEST_F(FigureTest, MabelHasClosedMeshesOfItsOwn) {
  const Figure figure = figure_of(mabel_, model::read_visuals(mabel_.skeleton.file));
  EXPECT_THAT(figure.messages, testing::IsEmpty());
  ASSERT_EQ(figure.parts.size(), mabel_.skeleton.bodies.size());
  for (const Part& part : figure.parts) {
    EXPECT_TRUE(mesh::is_closed(*std::get<std::shared_ptr<const mesh::Mesh>>(part.solid)))
        << mabel_.skeleton.bodies[static_cast<std::size_t>(part.body)].name;
  }
  // From hip to knee, from knee to toe: half a metre each (Table VI).
  double lowest = 0.0;
  for (const Eigen::Vector3d& corner :
       corners_of(figure.parts[static_cast<std::size_t>(mabel_.body_index("shin_left"))])) {
    lowest = std::min(lowest, corner.z());
  }
  EXPECT_NEAR(lowest, -0.5, 1e-4);
}

TEST_F(FigureTest, WithoutShapesSticksLeadFromJointToJointAndToTheFeet) {
  const Figure figure = figure_of(mabel_, {});
  const std::vector<Stick> sticks = sticks_of(mabel_);
  const auto of = [&](const std::string& name) {
    const int body = mabel_.body_index(name);
    const auto found =
        std::find_if(sticks.begin(), sticks.end(), [&](const Stick& s) { return s.body == body; });
    return found == sticks.end() ? Stick() : *found;
  };
  EXPECT_LT((of("thigh_left").to - Eigen::Vector3d(0, 0, -0.5)).norm(), 1e-12);
  EXPECT_LT((of("shin_right").to - Eigen::Vector3d(0, 0, -0.5)).norm(), 1e-12);
  EXPECT_LT((of("boom").to - Eigen::Vector3d(0, -2.25, 0)).norm(), 1e-12);
  for (std::size_t b = 0; b < mabel_.skeleton.bodies.size(); ++b) {
    if (mabel_.skeleton.bodies[b].mass > 0.0) {
      EXPECT_GT(parts_of(figure, static_cast<int>(b)), 0U) << mabel_.skeleton.bodies[b].name;
    }
  }
}

TEST_F(FigureTest, AMissingMeshGivesAMessageAndAStandIn) {
  model::Visuals visuals = model::read_visuals(mabel_.skeleton.file);
  std::get<model::MeshShape>(visuals.of_link["thigh_left"][0].shape).file = "/nowhere/thigh.obj";
  const Figure figure = figure_of(mabel_, visuals);
  ASSERT_EQ(figure.messages.size(), 1U);
  EXPECT_EQ(figure.messages[0],
            "/nowhere/thigh.obj: mesh: found no such file, expected a mesh; a stand-in is drawn");
  EXPECT_EQ(parts_of(figure, mabel_.body_index("thigh_left")), 3U);  // a rod with round ends
}

// A ball of mass m has I = 2/5 m r^2: the ellipsoid of a body with such an inertia is a ball, of the density
// of aluminium.
TEST(StandIn, ABodyWithoutSticksIsTheEllipsoidOfItsInertia) {
  model::Model model;
  model::Body body;
  body.name = "ball";
  body.mass = 1.0;
  body.inertia = 0.4 * 0.25 * 0.25 * Eigen::Matrix3d::Identity();
  model.skeleton.bodies = {body};
  model.skeleton.joints = {model::Joint()};
  const Figure figure = figure_of(model, {});
  ASSERT_EQ(figure.parts.size(), 1U);
  const Eigen::Vector3d radii = std::get<model::EllipsoidShape>(figure.parts[0].solid).radii;
  EXPECT_NEAR(radii.x(), radii.z(), 1e-12);
  EXPECT_NEAR(4.0 / 3.0 * M_PI * radii.prod() * 2700.0, 1.0, 1e-9);
}

}  // namespace
}  // namespace plumbline::render
