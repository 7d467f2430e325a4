// A good model.yaml, value by value.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "simulator/trace/units.h"
#include "tests/model/robot_texts.h"
#include "tests/model/test_laws.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using effects::Place;
using testing::ElementsAre;

constexpr double kPi = 3.14159265358979323846;

class GoodModelTest : public testing::Test {
 protected:
  /// Read once: libsdformat takes its time.
  static const Model& read_once(const std::string& path) {
    static const Model model = read_model(path, test::test_catalogue());
    return model;
  }
  static const test::TemporaryFolder& files() {
    static const test::TemporaryFolder folder;
    folder.write("arm.sdf", test::kSkeleton);
    folder.write("model.yaml", test::kModel);
    return folder;
  }
  const std::string path_ = files().path("model.yaml");
  const Model& model_ = read_once(path_);
};

TEST_F(GoodModelTest, HeadAndSkeleton) {
  EXPECT_EQ(model_.file, path_);
  EXPECT_EQ(model_.robot, "test arm");
  EXPECT_THAT(model_.lineage, ElementsAre(path_));
  EXPECT_EQ(model_.skeleton.bodies.size(), 3U);
  EXPECT_EQ(model_.skeleton.gravity, Eigen::Vector3d(0, 0, -9.81));
  EXPECT_EQ(model_.body_index("lower"), 2);
  EXPECT_EQ(model_.body_index("none"), -1);
  EXPECT_DOUBLE_EQ(model_.skeleton.bodies[1].mass_uncertainty, 0.02 * 2);
  EXPECT_DOUBLE_EQ(model_.skeleton.bodies[2].mass_uncertainty, 0.05);
  EXPECT_DOUBLE_EQ(model_.skeleton.bodies[0].mass_uncertainty, 0.0);
}

TEST_F(GoodModelTest, CoordinatesAreSumsOfJoints) {
  ASSERT_EQ(model_.coordinates.size(), 3U);
  EXPECT_FALSE(model_.find_coordinate("rail")->angular);
  const Coordinate& tip = *model_.find_coordinate("tip");
  EXPECT_TRUE(tip.angular);
  ASSERT_EQ(tip.terms.size(), 2U);
  EXPECT_EQ(tip.terms[1].of, "elbow");
  EXPECT_EQ(tip.terms[1].factor, 0.5);
  EXPECT_EQ(model_.find_coordinate("elbow"), nullptr);
}

TEST_F(GoodModelTest, MotorsAreInSi) {
  const Motor& rail = *model_.find_motor("mRail");
  EXPECT_TRUE(rail.angular);
  EXPECT_NEAR(rail.rotor_inertia.value, 20e-7, 1e-18);       // g cm^2
  EXPECT_NEAR(rail.rotor_inertia.uncertainty, 1e-7, 1e-18);  // 5 %
  EXPECT_NEAR(rail.torque_constant.value, 0.030, 1e-15);
  EXPECT_NEAR(rail.torque_constant.uncertainty, 0.001, 1e-15);  // in the value's unit
  EXPECT_NEAR(rail.factory_torque_constant.value, 0.033, 1e-15);
  EXPECT_EQ(rail.torque_constant.unit, "mN m/V");
  EXPECT_EQ(rail.torque_constant.source, "Table 2");
  EXPECT_FALSE(rail.torque_constant.assumed);
  EXPECT_EQ(rail.torque_constant.line, 16);
  EXPECT_EQ(rail.torque_limit.value, 2.0);
  EXPECT_TRUE(rail.torque_limit.assumed);
  const Motor& tip = *model_.find_motor("mTip");
  EXPECT_EQ(tip.torque_constant.value, 1.0);  // the command is a torque
  EXPECT_EQ(tip.factory_torque_constant.value, 0.0);
  EXPECT_EQ(tip.torque_limit.value, 0.0);
}

TEST_F(GoodModelTest, RatiosKeepTheirOrder) {
  const Ratio& rail = *model_.find_ratio("rail");
  EXPECT_NEAR(rail.to.front().factor, 100.0, 1e-12);  // 0.1 rad/mm
  const Ratio& tip = *model_.find_ratio("tip");
  EXPECT_EQ(tip.motor, "mTip");
  ASSERT_EQ(tip.to.size(), 2U);
  EXPECT_EQ(tip.to[0].of, "tip");
  EXPECT_EQ(tip.to[0].factor, -20.0);
  EXPECT_EQ(tip.to[1].of, "shoulder");
  EXPECT_EQ(tip.ratios[1].value, 3.0);
  ASSERT_EQ(model_.inertias.size(), 1U);
  EXPECT_EQ(model_.inertias[0].at, "mTip");
  EXPECT_EQ(model_.inertias[0].value.value, 2e-5);
}

TEST_F(GoodModelTest, EffectsTakeNullValuesForWhatIsLeftOut) {
  ASSERT_EQ(model_.effects.size(), 4U);
  EXPECT_EQ(model_.effects[0].label(), "drag at mTip");
  EXPECT_DOUBLE_EQ(model_.effects[0].values[0].uncertainty, 0.06);
  EXPECT_THAT(model_.effects[1].numbers(), ElementsAre(0.0, 0.3, -1.0));  // structural: the law's start
  EXPECT_THAT(model_.effects[2].numbers(), ElementsAre(5000.0, 0.0, 1.0));
  EXPECT_THAT(model_.effects[3].numbers(), ElementsAre(std::numeric_limits<double>::infinity(), 0.0));
  EXPECT_EQ(model_.effects[3].values[0].unit, "N m/rad");
}

TEST_F(GoodModelTest, SensorsAndTheirFloors) {
  const Sensor& tip = *model_.find_sensor("qTip");
  EXPECT_DOUBLE_EQ(tip.resolution, 2 * kPi / 4096);
  EXPECT_DOUBLE_EQ(tip.noise, 0.1 * kPi / 180);
  EXPECT_NEAR(tip.floor(), std::sqrt(std::pow(2 * kPi / 4096, 2) / 12 + std::pow(0.1 * kPi / 180, 2)), 1e-15);
  const Sensor& rail = *model_.find_sensor("qRail");
  EXPECT_NEAR(rail.resolution, 1e-6, 1e-20);
  EXPECT_NEAR(rail.offset, 2e-3, 1e-18);
  EXPECT_EQ(rail.source, "data sheet");
}

TEST_F(GoodModelTest, Places) {
  EXPECT_THAT(model_.places(Place::coordinate), ElementsAre("rail", "shoulder", "tip"));
  EXPECT_THAT(model_.places(Place::motor), ElementsAre("mRail", "mTip"));
  EXPECT_THAT(model_.places(Place::ratio), ElementsAre("rail", "tip"));
  EXPECT_THAT(model_.places(Place::body), ElementsAre("cart", "upper", "lower"));
  EXPECT_THAT(model_.places(Place::sensor), ElementsAre("qTip", "qRail"));
  EXPECT_THAT(model_.places(Place::world), ElementsAre("world"));
  EXPECT_FALSE(model_.place_is_angular(Place::coordinate, "rail"));
  EXPECT_TRUE(model_.place_is_angular(Place::ratio, "rail"));  // stretch in the motor's unit
  EXPECT_TRUE(model_.place_is_angular(Place::motor, "mTip"));
  EXPECT_FALSE(model_.place_is_angular(Place::sensor, "qRail"));
  EXPECT_TRUE(model_.place_is_angular(Place::body, "cart"));
}

TEST_F(GoodModelTest, ResolveTakesTheFirstKindThatKnowsTheName) {
  const effects::Catalogue catalogue = test::test_catalogue();
  EXPECT_EQ(model_.resolve(*catalogue.find("drag"), "rail"), Place::coordinate);
  EXPECT_EQ(model_.resolve(*catalogue.find("drag"), "mRail"), Place::motor);
  EXPECT_EQ(model_.resolve(*catalogue.find("stretch"), "rail"), Place::ratio);
  EXPECT_EQ(
      test::refusal([&] { model_.resolve(*catalogue.find("drag"), "mTop"); }),
      path_ + ": drag: found place \"mTop\", expected the name of a coordinate or motor; did you mean mTip?");
}

TEST(ModelTest, AJointTiedToCoordinatesIsNoPlaceForStretch) {
  const test::TemporaryFolder folder;
  folder.write("arm.sdf", test::kSkeleton);
  const std::string path = folder.write("model.yaml", R"(plumbline: model/1
robot: r
skeleton: arm.sdf
coordinates:
  shoulder: {of: {shoulder: 1}}
ratios:
  follow: {joint: elbow, of: {shoulder: {value: 2, unit: "1", source: s}}}
)");
  const Model model = read_model(path, test::test_catalogue());
  ASSERT_EQ(model.ratios.size(), 1U);
  EXPECT_EQ(model.ratios[0].motor, "elbow");
  EXPECT_EQ(model.ratios[0].to[0].of, "shoulder");
  EXPECT_TRUE(model.places(Place::ratio).empty());
  EXPECT_EQ(model.skeleton.gravity, Eigen::Vector3d(0, 0, -9.80665));
}

/// Two carts on one rail, the second of which mimics the first with a factor of -0.5 and an offset of 0.2 m.
std::string mimic_urdf() {
  const auto cart = [](const std::string& name, double mass) {
    return "<link name=\"" + name + "\"><inertial><mass value=\"" + std::to_string(mass) +
           "\"/><inertia ixx=\"1\" iyy=\"1\" izz=\"1\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\n";
  };
  const auto joint = [](const std::string& name, const std::string& more) {
    return "<joint name=\"to_" + name + "\" type=\"prismatic\"><parent link=\"base\"/><child link=\"" + name +
           "\"/><axis xyz=\"1 0 0\"/><limit lower=\"-9\" upper=\"9\" effort=\"9\" velocity=\"9\"/>" + more +
           "</joint>\n";
  };
  return "<robot name=\"carts\"><link name=\"base\"/>" + cart("a", 3.0) + cart("b", 2.0) + joint("a", "") +
         joint("b", "<mimic joint=\"to_a\" multiplier=\"-0.5\" offset=\"0.2\"/>") + "</robot>";
}

TEST(ModelTest, AJointThatMimicsAnotherGoesWithIt) {
  const test::TemporaryFolder folder;
  folder.write("carts.urdf", mimic_urdf());
  const std::string head = "plumbline: model/1\nrobot: r\nskeleton: carts.urdf\n";
  const std::string path = folder.write("model.yaml", head + "coordinates:\n  x: {of: {to_a: 2}}\n");
  const Model model = read_model(path, test::test_catalogue());
  ASSERT_EQ(model.ratios.size(), 1U);
  EXPECT_EQ(model.ratios[0].motor, "to_b");
  EXPECT_DOUBLE_EQ(model.ratios[0].to[0].factor, -0.25) << "x is twice the joint";
  EXPECT_NEAR(model.skeleton.joints.back().X_PJ.translation().x(), 0.2, 1e-12) << "the offset moves its zero";
  const Plant plant(model, {});
  EXPECT_EQ(plant.positions(), 1);
  const std::string none = folder.write("none.yaml", head + "coordinates:\n  y: {of: {to_b: 1}}\n");
  EXPECT_THAT(test::refusal([&] { read_model(none, test::test_catalogue()); }),
              testing::HasSubstr("no coordinate of joint \"to_a\" alone, which \"to_b\" mimics"));
}

TEST(ModelTest, EveryUnitOfTheCatalogueCanBeRead) {
  const effects::Catalogue catalogue = effects::Catalogue::all();
  for (const auto& law : catalogue.laws()) {
    for (const effects::Parameter& parameter : law->declaration().parameters) {
      for (const bool angular : {true, false}) {
        EXPECT_TRUE(unit_is_known(effects::unit_at(parameter.unit, angular)))
            << law->declaration().name << " " << parameter.name << ": " << parameter.unit;
      }
    }
  }
}

TEST(ModelTest, EveryRobotOfTheProjectCanBeRead) {
  int read = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(PLUMBLINE_ROOT "/robots")) {
    std::string first_line;
    std::getline(std::ifstream(entry.path()) >> std::ws, first_line);
    if (entry.path().extension() == ".yaml" && first_line.rfind("plumbline: model/", 0) == 0) {
      EXPECT_NO_THROW(read_model(entry.path().string(), known_effects())) << entry.path();
      ++read;
    }
  }
  EXPECT_GE(read, 2);
}

}  // namespace
}  // namespace plumbline::model
