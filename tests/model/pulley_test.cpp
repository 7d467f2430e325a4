// Pulleys: read, named like coordinates, moving with their own inertia.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "tests/model/robot_texts.h"
#include "tests/model/test_laws.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using effects::Place;
using testing::ElementsAre;

TEST(PulleyTest, PulleysCountAsCoordinates) {
  const test::TemporaryFolder folder;
  folder.write("arm.sdf", test::kSkeleton);
  const std::string path = folder.write("model.yaml", test::kPulleyModel);
  const Model model = read_model(path, test::test_catalogue());
  ASSERT_EQ(model.pulleys.size(), 2U);
  EXPECT_NEAR(model.find_pulley("drum")->inertia.value, 20e-7, 1e-18);
  EXPECT_NEAR(model.find_pulley("drum")->inertia.uncertainty, 1e-7, 1e-18);
  EXPECT_EQ(model.find_pulley("sum"), nullptr);
  EXPECT_THAT(model.places(Place::coordinate), ElementsAre("shoulder", "sum", "drum", "idler"));
  EXPECT_THAT(model.places(Place::ratio), ElementsAre("shoulder"));  // a tied pulley is never released
  EXPECT_EQ(model.resolve(*model.effects[0].law, "drum"), Place::coordinate);
  EXPECT_TRUE(model.place_is_angular(Place::coordinate, "drum"));
  EXPECT_EQ(model.ratios[1].motor, "idler");

  // rail, shoulder, elbow, drum are left; mTip and idler follow.
  Plant plant(model, {});
  ASSERT_EQ(plant.positions(), 4);
  Eigen::VectorXd x(plant.states());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    x[i] = 0.1 + 0.07 * static_cast<double>(i);
  }
  const auto at = [&](const std::string& name) { return plant.position_of(name, x.data()); };
  EXPECT_NEAR(at("mTip"), 10 * at("shoulder") - 3 * at("drum"), 1e-15);
  EXPECT_NEAR(at("sum"), at("elbow") + 0.5 * at("drum"), 1e-15);
  EXPECT_NEAR(at("idler"), 2 * at("drum") + at("sum"), 1e-15);
  Eigen::VectorXd reading(1);
  plant.outputs(x.data(), reading.data());
  EXPECT_DOUBLE_EQ(reading[0], at("drum"));

  // Every pulley's inertia is in the energy: without the idler's it is smaller by the idler's share.
  Model lighter = model;
  lighter.pulleys[1].inertia.value *= 0.5;
  Plant other(lighter, {});
  const double command = 0.0;
  const double spin = plant.velocity_of("idler", x.data());
  EXPECT_NEAR(plant.energetics(x.data(), &command).stored - other.energetics(x.data(), &command).stored,
              0.5 * 0.5e-4 * spin * spin, 1e-14);
}

TEST(PulleyTest, ALockedPulleyStandsStill) {
  const Model model = read_model(PLUMBLINE_ROOT "/robots/mabel/mabel_planar.yaml", known_effects());
  const Plant free(model, {});
  const Plant locked(model, {{"bsp_left", 0.1}, {"bsp_right", 0.0}});
  EXPECT_EQ(free.positions(), 13);
  EXPECT_EQ(locked.positions(), 11);
  const Eigen::VectorXd x = Eigen::VectorXd::Zero(locked.states());
  EXPECT_DOUBLE_EQ(locked.position_of("bsp_left", x.data()), 0.1);
}

}  // namespace
}  // namespace plumbline::model
