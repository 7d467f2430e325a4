// The 3-D skeleton's mass matrix by another multibody code: DART, built from the same numbers through its own
// interface. (Debian's DART reads no SDFormat of the version that the robots are written in.)
#include <gtest/gtest.h>

#include <cstdio>
#include <dart/dynamics/BodyNode.hpp>
#include <dart/dynamics/PrismaticJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/dynamics/Skeleton.hpp>
#include <dart/dynamics/WeldJoint.hpp>
#include <random>
#include <string>
#include <vector>

#include "simulator/model/mechanism.h"
#include "simulator/model/robot_file.h"

namespace plumbline::oracles {
namespace {

namespace dd = dart::dynamics;

template <typename Joint>
typename Joint::Properties turned(const model::Joint& joint) {
  typename Joint::Properties properties;
  properties.mName = joint.name;
  properties.mT_ParentBodyToJoint = joint.X_PJ;
  properties.mT_ChildBodyToJoint = joint.X_CJ;
  return properties;
}

template <typename Joint>
typename Joint::Properties along_axis(const model::Joint& joint) {
  auto properties = turned<Joint>(joint);
  properties.mAxis = joint.axis.normalized();
  return properties;
}

dd::BodyNode* add(dd::Skeleton& skeleton, const model::Joint& joint, const std::string& name,
                  dd::BodyNode* parent) {
  dd::BodyNode::Properties body;
  body.mName = name;
  switch (joint.type) {
    case model::JointType::revolute:
      return skeleton
          .createJointAndBodyNodePair<dd::RevoluteJoint>(parent, along_axis<dd::RevoluteJoint>(joint), body)
          .second;
    case model::JointType::prismatic:
      return skeleton
          .createJointAndBodyNodePair<dd::PrismaticJoint>(parent, along_axis<dd::PrismaticJoint>(joint), body)
          .second;
    case model::JointType::fixed:
      break;
  }
  return skeleton.createJointAndBodyNodePair<dd::WeldJoint>(parent, turned<dd::WeldJoint>(joint), body)
      .second;
}

dd::SkeletonPtr to_dart(const model::Skeleton& skeleton) {
  dd::SkeletonPtr built = dd::Skeleton::create(skeleton.file);
  std::vector<dd::BodyNode*> bodies(skeleton.bodies.size(), nullptr);
  for (const model::Joint& joint : skeleton.joints) {
    const auto child = static_cast<std::size_t>(joint.child);
    dd::BodyNode* parent = joint.parent < 0 ? nullptr : bodies[static_cast<std::size_t>(joint.parent)];
    const model::Body& body = skeleton.bodies[child];
    bodies[child] = add(*built, joint, body.name, parent);
    bodies[child]->setInertia(dd::Inertia(body.mass, body.com, body.inertia));
  }
  built->setGravity(skeleton.gravity);
  return built;
}

TEST(MabelByDart, MassMatrixAndBias) {
  for (const char* name : {"mabel.sdf", "mabel_planar.sdf"}) {
    const model::Skeleton skeleton =
        model::read_skeleton(std::string(PLUMBLINE_ROOT "/robots/mabel/") + name);
    model::Mechanism mechanism(skeleton);
    const dd::SkeletonPtr peer = to_dart(skeleton);
    const int n = mechanism.size();
    ASSERT_EQ(static_cast<int>(peer->getNumDofs()), n);
    Eigen::MatrixXd M;
    Eigen::VectorXd h;
    std::mt19937 generator(6);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    double worst_mass = 0.0;
    double worst_bias = 0.0;
    for (int i = 0; i < 100; ++i) {
      const Eigen::VectorXd q = Eigen::VectorXd::NullaryExpr(n, [&] { return 1.5 * unit(generator); });
      const Eigen::VectorXd v = Eigen::VectorXd::NullaryExpr(n, [&] { return 3.0 * unit(generator); });
      mechanism.evaluate(q, v, M, h);
      peer->setPositions(q);
      peer->setVelocities(v);
      const Eigen::MatrixXd& expected = peer->getMassMatrix();
      // Each entry relative to its row's and column's own inertia: small entries count too.
      const Eigen::VectorXd root = expected.diagonal().cwiseSqrt();
      worst_mass = std::max(worst_mass,
                            (M - expected).cwiseQuotient(root * root.transpose()).lpNorm<Eigen::Infinity>());
      const Eigen::VectorXd bias = peer->getCoriolisAndGravityForces();
      worst_bias =
          std::max(worst_bias, (h - bias).lpNorm<Eigen::Infinity>() / bias.lpNorm<Eigen::Infinity>());
    }
    std::printf("%s against DART: mass matrix %.2g, bias %.2g\n", name, worst_mass, worst_bias);
    EXPECT_LT(worst_mass, 1e-9) << name;
    EXPECT_LT(worst_bias, 1e-9) << name;
  }
}

}  // namespace
}  // namespace plumbline::oracles
