// The linearisation of links in contact, against differences of the rates; and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "tests/trace/refusal.h"
#include "tests/trace/temporary_folder.h"

namespace plumbline::model {
namespace {

using testing::HasSubstr;

/// A floating arm of two hinges and a slide, and a free body beside it.
constexpr const char* kArm = R"(<mujoco><option gravity="0 0 -9.81"/><worldbody>
  <body name="trunk"><freejoint/>
    <inertial pos="0.02 0.01 0" mass="3" diaginertia="0.03 0.04 0.02"/>
    <body name="upper" pos="0.1 0 0.05"><joint name="yaw" axis="0 0.2 1"/>
      <geom name="upper" type="capsule" fromto="0 0 0 0.2 0.05 0" size="0.03" mass="1"/>
      <body name="lower" pos="0.2 0.05 0"><joint name="slide" type="slide" axis="1 0.3 0"/>
        <geom name="tip" size="0.04" pos="0.1 0 0.02" mass="0.5"/>
      </body>
    </body>
  </body>
  <body name="crate"><freejoint/>
    <geom type="box" size="0.1 0.08 0.06" mass="2"/>
    <geom name="rail" type="capsule" fromto="-0.1 0 0.1 0.1 0.03 0.1" size="0.02" mass="0.2"/>
    <geom name="knob" size="0.03" pos="0 0.1 0" mass="0.1"/>
  </body>
</worldbody></mujoco>)";

const char* const kLaws = R"(
  - effect: ground_normal
    at: pair
    values: {stiffness: {value: 2e6, unit: N, assumed: t}, damping: {value: 3e5, unit: N s/m, assumed: t}}
  - effect: ground_friction
    at: pair
    values:
      bristle_stiffness: {value: 2e4, unit: 1/m, assumed: t}
      bristle_damping: {value: 20, unit: s/m, assumed: t}
      friction: {value: 0.8, unit: '1', assumed: t}
      lateral: {value: 0.7, unit: '1', assumed: t}
  - effect: ground_height_error
    at: pair
    values: {height: {value: 0, unit: m, assumed: t}}
)";

const char* const kCoulombLaws = R"(
  - effect: ground_normal
    at: pair
    values: {stiffness: {value: 2e6, unit: N, assumed: t}, damping: {value: 3e5, unit: N s/m, assumed: t}}
  - effect: ground_coulomb
    at: pair
    values:
      friction: {value: 0.8, unit: '1', assumed: t}
      viscous: {value: 0.1, unit: s/m, assumed: t}
      slip_speed: {value: 0.2, unit: m/s, assumed: t}
      lateral: {value: 0.7, unit: '1', assumed: t}
  - effect: ground_friction_error
    at: pair
    values: {scale: {value: 1, unit: '1', assumed: t}}
)";

const char* const kCrate = "{link: crate, value: [0, 0, 0], unit: m, box: [0.2, 0.16, 0.12]}";

class LinkContactFile : public testing::Test {
 protected:
  Model model(const std::string& between, const std::string& laws = kLaws) const {
    return with("contacts: {pair: {between: [" + between + "], assumed: test}}\n", laws);
  }
  Model with(const std::string& contacts, const std::string& laws) const {
    folder_.write("arm.xml", kArm);
    const std::string text = "plumbline: model/1\nrobot: arm\nskeleton: arm.xml\n" + contacts;
    return read_model(folder_.write("model.yaml", text + (laws.empty() ? "" : "effects:" + laws)),
                      known_effects());
  }
  std::string refusal(const std::string& contacts, const std::string& laws = "") const {
    return test::refusal([&] { with(contacts, laws); });
  }

  test::TemporaryFolder folder_;
};

class LinkContactSlopes : public LinkContactFile, public testing::WithParamInterface<std::string> {};

Eigen::VectorXd rate_at(Plant& plant, const Eigen::VectorXd& x) {
  Eigen::VectorXd xdot = Eigen::VectorXd::Zero(x.size());
  plant.rate(x.data(), nullptr, xdot.data());
  return xdot;
}

/// Somewhere, everything in motion, the contact's first point a millimetre deep: the crate is shifted along
/// the normal.
Eigen::VectorXd pressed(Plant& plant, std::mt19937_64& random) {
  std::uniform_real_distribution<double> spread(-0.4, 0.4);
  Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(plant.states(), [&]() { return spread(random); });
  x.tail(plant.states() - 2 * plant.positions()) *= 1e-4;
  for (int round = 0; round < 60; ++round) {
    LinkTouch deepest = plant.link_touches(x.data()).front();
    for (const LinkTouch& touch : plant.link_touches(x.data())) {
      deepest = touch.depth > deepest.depth ? touch : deepest;
    }
    const double side = plant.model().contacts[0].ends[static_cast<std::size_t>(deepest.first)].body ==
                                plant.model().body_index("crate")
                            ? 1.0
                            : -1.0;  // is the crate the first link here?
    x.segment<3>(8) += side * (deepest.depth - 1e-3) * deepest.normal();
  }
  return x;
}

void expect_slopes_of_the_rates(Plant& plant, const std::vector<ParameterId>& parameters,
                                const Eigen::Vector4d& steps) {
  const Eigen::Index n = plant.positions();
  ASSERT_EQ(n, 14);
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::VectorXd x = pressed(plant, random);
    double deepest = -1.0;
    for (const LinkTouch& touch : plant.link_touches(x.data())) {
      deepest = std::max(deepest, touch.depth);
    }
    ASSERT_NEAR(deepest, 1e-3, 1e-9);
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(x.size());
    Eigen::MatrixXd A, B;
    plant.tangent({x.data(), still.data(), nullptr, nullptr, 1e-3}, parameters, steps, true, A, B);
    const double largest = A.middleRows(n, n).cwiseAbs().maxCoeff();
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double step = i < n ? 1e-8 : 1e-7;
      Eigen::VectorXd moved = x;
      moved[i] = x[i] + step;
      const Eigen::VectorXd up = rate_at(plant, moved);
      moved[i] = x[i] - step;
      const Eigen::VectorXd expected = (up - rate_at(plant, moved)) / (2.0 * step);
      EXPECT_LT((A.col(i) - expected).norm(), 2e-5 * expected.norm() + 1e-7 * largest)
          << plant.state_names()[static_cast<std::size_t>(i)] << ": " << expected.norm();
    }
    for (Eigen::Index p = 0; p < 4; ++p) {
      const double here = plant.value(parameters[static_cast<std::size_t>(p)]);
      const double step = 10.0 * steps[p];
      plant.set_value(parameters[static_cast<std::size_t>(p)], here + step);
      const Eigen::VectorXd up = rate_at(plant, x);
      plant.set_value(parameters[static_cast<std::size_t>(p)], here - step);
      const Eigen::VectorXd expected = (up - rate_at(plant, x)) / (2.0 * step);
      plant.set_value(parameters[static_cast<std::size_t>(p)], here);
      EXPECT_GT(expected.norm(), 0.0) << p;
      EXPECT_LT((B.col(p) - expected).norm(), 1e-4 * expected.norm()) << p;
    }
  }
}

TEST_P(LinkContactSlopes, AreThoseOfTheRates) {
  Plant plant(model(GetParam()), {});
  expect_slopes_of_the_rates(plant, {{0, 0}, {0, 1}, {1, 2}, {2, 0}}, {1.0, 1.0, 1e-6, 1e-9});
}

TEST_P(LinkContactSlopes, AreThoseOfTheRatesUnderCoulombFriction) {
  Plant plant(model(GetParam(), kCoulombLaws), {});
  expect_slopes_of_the_rates(plant, {{0, 0}, {0, 1}, {1, 0}, {2, 0}}, {1.0, 1.0, 1e-6, 1e-6});
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, LinkContactSlopes,
    testing::Values("{sphere: tip}, {sphere: knob}", "{sphere: tip}, {capsule: rail}",
                    "{capsule: rail}, {sphere: tip}", "{capsule: upper}, {capsule: rail}",
                    std::string("{sphere: tip}, ") + kCrate,
                    std::string(kCrate) +
                        ", {link: upper, value: [0.1, 0.02, 0.03], unit: m, plane: [0.1, -0.2, 1]}",
                    "{capsule: rail}, {link: world, value: [0, 0, -300], unit: mm, plane: [0, 0.2, 1]}"));

// Over a motion that leads into contact the slope is the mean on the way: times the change of the state it is
// the change of the rate, also across the surface.
TEST_F(LinkContactFile, SlopesAreMeansOverTheMotion) {
  Plant plant(model("{sphere: tip}, {sphere: knob}"), {});
  std::mt19937_64 random(3);
  Eigen::VectorXd middle = pressed(plant, random);
  middle.tail(plant.states() - plant.positions()).setZero();
  const Eigen::Vector3d out = plant.link_touches(middle.data()).front().normal();
  middle.segment<3>(8) -= 1e-3 * out;  // the crate, which has the second shape
  ASSERT_NEAR(plant.link_touches(middle.data()).front().depth, 0.0, 1e-9);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(plant.states());
  change.segment<3>(8) = 2e-4 * out;
  Eigen::MatrixXd A, B;
  plant.tangent({middle.data(), change.data(), nullptr, nullptr, 1e-3}, {}, Eigen::VectorXd(0), true, A, B);
  const Eigen::VectorXd expected =
      rate_at(plant, middle + 0.5 * change) - rate_at(plant, middle - 0.5 * change);
  EXPECT_GT(expected.norm(), 1.0);
  EXPECT_LT((A * change - expected).norm(), 1e-3 * expected.norm());
}

TEST_F(LinkContactFile, BadContactsAreRefusedInOneLine) {
  const auto between = [&](const std::string& ends) {
    return refusal("contacts: {pair: {between: [" + ends + "], assumed: test}}\n");
  };
  EXPECT_THAT(between("{sphere: tip}"),
              HasSubstr("model.yaml:4: contacts.pair.between: found 1 shape, expected two"));
  EXPECT_THAT(between("{sphere: tap}, {sphere: knob}"), HasSubstr("did you mean tip?"));
  EXPECT_THAT(between("{sphere: tip}, {capsule: rails}"), HasSubstr("did you mean rail?"));
  EXPECT_THAT(between(std::string("{sphere: knob}, ") + kCrate),
              HasSubstr("found both shapes on the same link, or on links that are fixed to each other"));
  EXPECT_THAT(
      between(std::string("{capsule: upper}, ") + kCrate),
      HasSubstr(
          "contacts.pair.between: found a capsule and a box, expected a point or sphere beside any shape"));
  const std::string end = "{sphere: tip}, {link: crate, value: [0, 0, 0], unit: m, ";
  EXPECT_THAT(between(end + "radius: -1}"), HasSubstr("radius: found \"-1\", expected a number above zero"));
  EXPECT_THAT(between(end + "to: [0, 0, 0], radius: 1}"), HasSubstr("found the same point as `value`"));
  EXPECT_THAT(between(end + "to: [0, 0, 1]}"), HasSubstr("radius"));
  EXPECT_THAT(between(end + "box: [1, 0, 1]}"), HasSubstr("expected three edges above zero"));
  EXPECT_THAT(between(end + "box: [1, 1, 1], radius: 1}"), HasSubstr("radius"));
  EXPECT_THAT(between(end + "plane: [0, 0, 0]}"), HasSubstr("found a direction of zeros"));
  EXPECT_THAT(between("{sphere: tip}, {link: crate, value: [0, 0, 0], unit: kg, radius: 1}"),
              HasSubstr("unit: found unit \"kg\", expected a unit like \"m\""));
  EXPECT_THAT(between("{sphere: tip}, {link: crute, value: [0, 0, 0], unit: m}"),
              HasSubstr("did you mean crate?"));
  EXPECT_THAT(refusal("contacts: {pair: {between: [{sphere: tip}, {sphere: knob}]}}\n"), HasSubstr("source"));
  EXPECT_THAT(
      refusal("feet: {tip: {sphere: tip}}\ncontacts: {tip: {between: [{sphere: tip}, {sphere: knob}], "
              "assumed: t}}\n"),
      HasSubstr("found the name of a foot, \"tip\", expected a name of its own"));
  EXPECT_THAT(refusal("contacts: {pair: {between: [{sphere: tip}, {sphere: knob}], assumed: t}}\n",
                      "\n  - {effect: ground_normal, at: pear, values: {}}\n"),
              HasSubstr("expected the name of a foot or contact"));
}

}  // namespace
}  // namespace plumbline::model
