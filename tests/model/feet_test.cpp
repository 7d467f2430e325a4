// Feet: read, standing on the ground, thrown back by it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/run/commanded_run.h"
#include "simulator/trace/error.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A block of 2 kg that moves along x and z without turning; its foot is 0.3 m below.
const char* const kSkeleton = R"(<?xml version="1.0"?>
<sdf version="1.9">
  <model name="block">
    <link name="slider">
      <inertial><mass>0.5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
    </link>
    <link name="block">
      <inertial><mass>1.5</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
    </link>
    <link name="post">
      <inertial><mass>1</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
    </link>
    <joint name="x" type="prismatic">
      <parent>world</parent><child>slider</child><axis><xyz>1 0 0</xyz></axis>
    </joint>
    <joint name="z" type="prismatic">
      <parent>slider</parent><child>block</child><axis><xyz>0 0 1</xyz></axis>
    </joint>
    <joint name="bolt" type="fixed"><parent>world</parent><child>post</child></joint>
  </model>
</sdf>
)";

std::string model_text(double gravity, const std::string& foot, const std::string& ground) {
  return "plumbline: model/1\nrobot: block\nskeleton: block.sdf\ngravity: {value: " +
         std::to_string(gravity) +
         ", unit: m/s^2, assumed: test}\ncoordinates:\n  x: {of: {x: 1}}\n  z: {of: {z: 1}}\nfeet:\n  "
         "foot: " +
         foot + "\neffects:\n" + ground;
}

const char* const kFoot = "{link: block, value: [0, 0, -0.3], unit: m, assumed: test}";

std::string ground(double root, bool friction) {
  std::string text =
      "  - effect: ground_normal\n    at: foot\n    values:\n"
      "      stiffness: {value: 2e6, unit: N, assumed: test}\n"
      "      damping: {value: 4e5, unit: N s/m, assumed: test}\n"
      "      root_damping: {value: " +
      std::to_string(root) +
      ", unit: N, assumed: test}\n"
      "      rounding: {value: 1e-4, unit: m/s, assumed: test}\n";
  if (friction) {
    text +=
        "  - effect: ground_friction\n    at: foot\n    values:\n"
        "      bristle_stiffness: {value: 260, unit: 1/m, assumed: test}\n"
        "      bristle_damping: {value: 2.25, unit: s/m, assumed: test}\n"
        "      friction: {value: 0.5, unit: '1', assumed: test}\n"
        "      viscous: {value: 0.1, unit: s/m, assumed: test}\n";
  }
  return text;
}

class FeetTest : public testing::Test {
 protected:
  Model model(double gravity, const std::string& foot, const std::string& effects) const {
    folder_.write("block.sdf", kSkeleton);
    return read_model(folder_.write("model.yaml", model_text(gravity, foot, effects)), known_effects());
  }

  static run::CommandedRun run(Plant& plant, const Eigen::VectorXd& x0, Eigen::Index samples) {
    run::CommandedOptions options;
    options.integrator.method = integrate::Method::rosenbrock;
    options.integrator.relative_tolerance = 1e-7;
    options.integrator.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-10);
    return run::run_commands(plant, x0, Eigen::MatrixXd::Zero(0, samples), 1e-3, 0.0, {}, nullptr, options);
  }

  std::string refusal(const std::string& foot) const {
    try {
      Plant plant(model(0.0, foot, ground(0.0, false)), {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
};

// Without gravity and root term: a (v_in + v_out) = ln((1 + a v_in)/(1 - a v_out)), a = damping/stiffness
// (Hunt and Crossley 1975, integrated).
TEST_F(FeetTest, AnImpactReboundsAsTheClosedForm) {
  Plant plant(model(0.0, kFoot, ground(0.0, false)), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[1] = 0.3005;
  x[3] = -1.2;
  const run::CommandedRun result = run(plant, x, 60);
  const double v_out = result.states(3, 59);
  const double a = 0.2;
  EXPECT_GT(v_out, 0.5);
  EXPECT_NEAR(a * (1.2 + v_out), std::log((1.0 + a * 1.2) / (1.0 - a * v_out)), 1e-8);
  EXPECT_EQ(result.summary.switches_found, 2);  // touchdown and lift-off are located
}

TEST_F(FeetTest, EnergyIsAccountedForWhileTheFootSlidesAndComesToRest) {
  Plant plant(model(9.81, kFoot, ground(3e5, true)), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[1] = 0.31;
  x[2] = 0.8;
  const run::CommandedRun result = run(plant, x, 1500);
  EXPECT_LT(std::abs(result.energy_error), 1e-6 * result.energy_exchanged);
  Eigen::VectorXd end = result.states.col(1499);
  const Touch touch = plant.touches(end.data())[0];
  EXPECT_NEAR(touch.force.z(), 1.5 * 9.81, 1e-2);  // it stands: the ground carries the block, not the slider
  EXPECT_LT(touch.velocity.norm(), 1e-5);
}

constexpr const char* kSurface = "f 1 3 2\nf 1 2 4\nf 1 4 3\n";
constexpr const char* kCorners = "v 0 0 0\nv 60 0 0\nv 0 60 0\nv 0 0 60\n";
const char* const kShoe = "{link: block, value: [10, 0, -300], unit: mm, mesh: shoe.obj, assumed: test}";

TEST_F(FeetTest, ThePointsOfAConvexMeshAreFeetOfOneGroup) {
  folder_.write("shoe.obj", std::string(kCorners) + kSurface + "f 2 3 4\n");
  const Model shod = model(9.81, kShoe, ground(0.0, false));
  ASSERT_EQ(shod.feet.size(), 4U);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Foot& foot : shod.feet) {
    EXPECT_EQ(foot.group, "foot");
    EXPECT_EQ(foot.radius, 0.0);
    sum += foot.point;
  }
  EXPECT_LT((sum - Eigen::Vector3d(0.1, 0.06, -1.14)).norm(), 1e-7);
}

// With a fifth point at (10, 10, 10) mm in place of a face: the plane of (60, 0, 0), (0, 60, 0) and it has
// the normal (1, 1, 4), and (0, 0, 60) lies 180 mm/sqrt(18) in front of it.
TEST_F(FeetTest, AMeshThatIsOpenOrDentedIsRefused) {
  folder_.write("shoe.obj", std::string(kCorners) + kSurface);
  EXPECT_THAT(refusal(kShoe), AllOf(HasSubstr("model.yaml:9"), HasSubstr("a mesh that is not closed")));
  folder_.write("shoe.obj",
                std::string(kCorners) + "v 10 10 10\n" + kSurface + "f 2 3 5\nf 3 4 5\nf 4 2 5\n");
  EXPECT_THAT(refusal(kShoe),
              HasSubstr("a point 0.0424 m in front of one of its faces, expected a convex one"));
  EXPECT_THAT(refusal("{link: block, value: [0, 0, 0], unit: m, mesh: none.stl, assumed: test}"),
              HasSubstr("no such file"));
}

// At constant load LuGre slides with force friction + viscous * v.
TEST_F(FeetTest, FrictionOpposesTheSlip) {
  Plant plant(model(9.81, kFoot, ground(3e5, true)), {});
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x[1] = 0.29979;
  x[2] = 2.0;
  const run::CommandedRun result = run(plant, x, 200);
  Eigen::VectorXd late = result.states.col(199);
  const Touch touch = plant.touches(late.data())[0];
  const double v = touch.velocity.x();
  ASSERT_GT(v, 0.3);
  EXPECT_NEAR(touch.force.x() / touch.force.z(), -(0.5 + 0.1 * v), 0.01);
}

TEST_F(FeetTest, AStateThatIsNoNumberGivesRatesThatAreNone) {
  Plant plant(model(9.81, kFoot, ground(3e5, true)), {});
  Eigen::VectorXd x = Eigen::VectorXd::Constant(plant.states(), 0.1);
  x[0] = std::nan("");
  Eigen::VectorXd rate(plant.states());
  EXPECT_NO_THROW(plant.rate(x.data(), nullptr, rate.data()));
  EXPECT_FALSE(rate.allFinite());
}

TEST_F(FeetTest, AContactSwitchIsReadAndNamesAFoot) {
  folder_.write("block.sdf", kSkeleton);
  const auto with_switch = [&](const std::string& entry) {
    const std::string text =
        model_text(9.81, kFoot, ground(0.0, false)) + "sensors:\n  sole: " + entry + "\n";
    return read_model(folder_.write("model.yaml", text), known_effects());
  };
  const Model read = with_switch("{contact: foot, assumed: test}");
  ASSERT_EQ(read.switches.size(), 1U);
  EXPECT_EQ(read.switches[0].name, "sole");
  EXPECT_EQ(read.switches[0].foot, 0);
  EXPECT_TRUE(read.sensors.empty());
  const auto refusal_of = [&](const std::string& entry) -> std::string {
    try {
      with_switch(entry);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal_of("{contact: fot, assumed: test}"), AllOf(HasSubstr("fot"), HasSubstr("foot")));
  EXPECT_THAT(refusal_of("{contact: foot, measures: x, assumed: test}"), HasSubstr("measures"));
}

// A ground that is 3 mm higher pushes as the old one does 3 mm further down; one of twice the stiffness
// pushes twice as hard where nothing moves.
TEST_F(FeetTest, ErrorsOfTheGroundChangeItsPush) {
  const auto push = [&](double z, const std::string& effects) {
    Plant plant(model(9.81, kFoot, ground(0.0, false) + effects), {});
    Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
    x[1] = z;
    return plant.touches(x.data())[0].force.z();
  };
  const auto effect = [](const std::string& name, const std::string& value) {
    return "  - effect: " + name + "\n    at: foot\n    values: {" + value + ", assumed: test}}\n";
  };
  const double expected = 2e6 * std::pow(0.004, 1.5);  // Hertz, 4 mm deep
  EXPECT_NEAR(push(0.296, ""), expected, 1e-9);
  EXPECT_NEAR(push(0.299, effect("ground_height_error", "height: {value: 3, unit: mm")), expected, 1e-9);
  EXPECT_NEAR(push(0.296, effect("ground_stiffness_error", "scale: {value: 2, unit: '1'")), 2.0 * expected,
              1e-9);
}

TEST_F(FeetTest, BadFeetAreRefused) {
  EXPECT_THAT(refusal("{link: blok, value: [0, 0, 0], unit: m, assumed: test}"),
              AllOf(HasSubstr("model.yaml"), HasSubstr("blok"), HasSubstr("block")));
  EXPECT_THAT(refusal("{link: block, value: [0, 0], unit: m, assumed: test}"), HasSubstr("2 numbers"));
  EXPECT_THAT(refusal("{link: block, value: [0, 0, 0], unit: s, assumed: test}"),
              HasSubstr("a unit like \"m\""));
  EXPECT_THAT(refusal("{link: block, value: [0, 0, 0], unit: m}"), HasSubstr("source"));
  EXPECT_THAT(refusal("{link: post, value: [0, 0, 0], unit: m, assumed: test}"),
              HasSubstr("fixed to the world"));
}

}  // namespace
}  // namespace plumbline::model
