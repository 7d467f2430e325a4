// A payload against the same robot with the payload as a link of its own.
#include "simulator/effects/payload.h"

#include <gtest/gtest.h>

#include "simulator/effects/catalogue.h"
#include "simulator/model/plant.h"

namespace plumbline::model {
namespace {

/// Two links with hinges about different axes, so that every part of the tensor is felt.
Model two_links() {
  Model model;
  model.file = "two_links";
  for (const char* name : {"upper", "lower"}) {
    Body body;
    body.name = name;
    body.mass = 1.3;
    body.com = {0.02, -0.03, -0.2};
    body.inertia = Eigen::Vector3d(0.02, 0.018, 0.004).asDiagonal();
    model.skeleton.bodies.push_back(body);
  }
  for (int j = 0; j < 2; ++j) {
    Joint joint;
    joint.name = j == 0 ? "shoulder" : "elbow";
    joint.type = JointType::revolute;
    joint.parent = j - 1;
    joint.child = j;
    joint.axis = j == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d(1.0, 0.0, 1.0).normalized();
    joint.X_PJ.translation() = Eigen::Vector3d(0.0, 0.05, j == 0 ? 0.0 : -0.4);
    model.skeleton.joints.push_back(joint);
  }
  return model;
}

const Eigen::Vector3d kAt(0.05, -0.07, -0.31);
constexpr double kMass = 0.8;

Model with_payload(double mass) {
  Model model = two_links();
  EffectUse use;
  use.law = effects::Catalogue::all().find("payload");
  use.at = "lower";
  for (const double value : {mass, kAt.x(), kAt.y(), kAt.z()}) {
    Quantity quantity;
    quantity.value = value;
    use.values.push_back(quantity);
  }
  model.effects.push_back(use);
  return model;
}

/// A third link, fixed to the second, that is a small heavy ball at the same point.
Model with_ball() {
  Model model = two_links();
  Body ball;
  ball.name = "ball";
  ball.mass = kMass;
  ball.inertia = 1e-12 * Eigen::Matrix3d::Identity();
  model.skeleton.bodies.push_back(ball);
  Joint fixed;
  fixed.name = "grip";
  fixed.parent = 1;
  fixed.child = 2;
  fixed.X_PJ.translation() = kAt;
  model.skeleton.joints.push_back(fixed);
  return model;
}

Eigen::VectorXd rate_of(const Model& model) {
  Plant plant(model, {});
  const Eigen::VectorXd x = (Eigen::VectorXd(4) << 0.4, -0.9, 1.7, -2.3).finished();
  Eigen::VectorXd rate(plant.states());
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(plant.motors());
  plant.rate(x.data(), none.data(), rate.data());
  return rate;
}

TEST(Payload, MovesAsALinkOfItsOwnWould) {
  const Eigen::VectorXd expected = rate_of(with_ball());
  EXPECT_GT((rate_of(two_links()) - expected).norm(), 0.1) << "the payload matters here";
  EXPECT_LT((rate_of(with_payload(kMass)) - expected).norm(), 1e-9 * expected.norm());
}

TEST(Payload, OfNoMassIsNone) {
  EXPECT_EQ(rate_of(with_payload(0.0)), rate_of(two_links()));
  const auto law = effects::Catalogue::all().find("payload");
  const effects::Values values{0.0, 0.1, 0.2, 0.3};
  EXPECT_TRUE(law->is_null(values.data()));
}

}  // namespace
}  // namespace plumbline::model
