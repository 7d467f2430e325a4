// Closed-form slopes of trees of bodies against central differences of their equations of motion.
#include "simulator/model/tree_slopes.h"

#include <gtest/gtest.h>

#include <random>

namespace plumbline::model {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double kStep = 1e-5;
// Rounding over the step and its square, of terms of size 10: some 1e-10 each.
constexpr double kNear = 2e-8;
const Vector3d kGravity(0.3, -0.2, -9.8);

struct RandomTree {
  std::mt19937 draw;
  std::vector<TreeBody> bodies;
  int coordinates = 0;

  explicit RandomTree(unsigned seed) : draw(seed) {}
  double number() { return std::uniform_real_distribution<double>(-1.0, 1.0)(draw); }
  Vector3d vector() { return {number(), number(), number()}; }

  enum class Kind { turn, slide, bent, weld };
  int add(int parent, Kind kind, double mass, const Vector3d& axis) {
    TreeBody body;
    body.parent = parent;
    body.coordinate = kind == Kind::weld ? -1 : coordinates++;
    body.slides = kind == Kind::slide || kind == Kind::bent;
    body.axis = axis.normalized();
    body.hinge = mass > 0.0 ? Vector3d(0.3 * vector()) : Vector3d::Zero();
    if (kind == Kind::bent) {
      body.arc.turn = 0.4 * body.axis.cross(vector());
      body.arc.straight = 0.2;
    }
    body.X_PB.setIdentity();
    if (mass > 0.0) {
      body.X_PB.translation() = vector();
      body.X_PB.linear() = Eigen::AngleAxisd(number(), vector().normalized()).toRotationMatrix();
    }
    body.mass = mass;
    body.com = 0.2 * vector();
    body.inertia.setZero();
    if (mass > 0.0) {
      const Eigen::Matrix3d root = Eigen::Matrix3d::NullaryExpr([&] { return 0.3 * number(); });
      body.inertia = root * root.transpose() + 0.05 * Eigen::Matrix3d::Identity();
    }
    bodies.push_back(body);
    return static_cast<int>(bodies.size()) - 1;
  }
  /// Three ways and yaw, pitch and roll, with bodies without mass between them.
  int floating_base() {
    int last = -1;
    for (const int axis : {0, 1, 2}) {
      last = add(last, Kind::slide, 0.0, Vector3d::Unit(axis));
    }
    last = add(last, Kind::turn, 0.0, Vector3d::UnitZ());
    last = add(last, Kind::turn, 0.0, Vector3d::UnitY());
    return add(last, Kind::turn, 3.0, Vector3d::UnitX());
  }
};

/// A trunk on a floating base with two legs, one of them forked, with a weld, slides and a bent slide.
RandomTree floating_tree(unsigned seed) {
  using Kind = RandomTree::Kind;
  RandomTree tree(seed);
  const int trunk = tree.floating_base();
  const int hip = tree.add(trunk, Kind::turn, 1.0, tree.vector());
  const int thigh = tree.add(hip, Kind::turn, 0.7, tree.vector());
  tree.add(thigh, Kind::slide, 0.4, tree.vector());
  tree.add(tree.add(thigh, Kind::weld, 0.2, tree.vector()), Kind::turn, 0.3, tree.vector());
  tree.add(tree.add(trunk, Kind::bent, 0.8, tree.vector()), Kind::turn, 0.5, tree.vector());
  return tree;
}

/// Two arms on the world, one behind a bent slide.
RandomTree fixed_tree(unsigned seed) {
  using Kind = RandomTree::Kind;
  RandomTree tree(seed);
  const int first = tree.add(-1, Kind::turn, 1.0, tree.vector());
  tree.add(tree.add(first, Kind::slide, 1.0, tree.vector()), Kind::turn, 0.5, tree.vector());
  tree.add(tree.add(-1, Kind::bent, 0.7, tree.vector()), Kind::turn, 0.4, tree.vector());
  return tree;
}

/// Not the code under test: the two methods of tree_dynamics.h.
VectorXd forces(TreeDynamics& tree, const VectorXd& q, const VectorXd& v, const VectorXd& a) {
  MatrixXd M;
  VectorXd h;
  tree.place(q);
  tree.assemble(v, M, h);
  return M * a + h;
}

struct Slopes {
  MatrixXd by_position, by_velocity;
};

/// Central differences of any vector that depends on q and v.
template <class Function>
Slopes differences(const Function& function, const VectorXd& q, const VectorXd& v) {
  const Eigen::Index rows = function(q, v).size();
  Slopes slopes{MatrixXd(rows, q.size()), MatrixXd(rows, q.size())};
  for (Eigen::Index i = 0; i < q.size(); ++i) {
    const VectorXd step = kStep * VectorXd::Unit(q.size(), i);
    slopes.by_position.col(i) = (function(q + step, v) - function(q - step, v)) / (2.0 * kStep);
    slopes.by_velocity.col(i) = (function(q, v + step) - function(q, v - step)) / (2.0 * kStep);
  }
  return slopes;
}

class TreeSlopesOf : public testing::TestWithParam<bool> {
 protected:
  static RandomTree tree(unsigned seed) { return GetParam() ? floating_tree(seed) : fixed_tree(seed); }
};

TEST_P(TreeSlopesOf, InverseDynamicsAreThoseOfDifferences) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomTree random = tree(seed);
    const int n = random.coordinates;
    TreeDynamics dynamics(random.bodies, n, kGravity);
    const auto draw = [&](double size) {
      return VectorXd(VectorXd::NullaryExpr(n, [&] { return size * random.number(); }));
    };
    const VectorXd q = draw(1.2), v = draw(2.0), a = draw(5.0);
    const Slopes expected = differences(
        [&](const VectorXd& at, const VectorXd& rate) { return forces(dynamics, at, rate, a); }, q, v);
    forces(dynamics, q, v, a);
    TreeSlopes slopes;
    slopes.set(dynamics, a);
    Slopes found;
    slopes.inverse_dynamics(found.by_position, found.by_velocity);
    const double size = expected.by_position.norm() + expected.by_velocity.norm();
    EXPECT_LT((found.by_position - expected.by_position).norm(), kNear * size) << "tree " << seed;
    EXPECT_LT((found.by_velocity - expected.by_velocity).norm(), kNear * size) << "tree " << seed;
    EXPECT_GT(expected.by_position.norm(), 0.1);
    EXPECT_GT(expected.by_velocity.norm(), 0.1);
  }
}

TEST_P(TreeSlopesOf, WhatIsFeltAtAPointIsThatOfDifferences) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomTree random = tree(seed);
    const int n = random.coordinates;
    TreeDynamics dynamics(random.bodies, n, kGravity);
    const auto draw = [&](double size) {
      return VectorXd(VectorXd::NullaryExpr(n, [&] { return size * random.number(); }));
    };
    const VectorXd q = draw(1.2), v = draw(2.0), a = draw(5.0);
    const Vector3d point = random.vector();
    for (int body = 0; body < static_cast<int>(random.bodies.size()); ++body) {
      const auto felt = [&](const VectorXd& at, const VectorXd& rate) {
        forces(dynamics, at, rate, a);
        const Vector3d p = dynamics.station(body, point);
        VectorXd both(6);
        both.head<3>() = dynamics.rotation(body).transpose() * dynamics.angular_velocity(body);
        both.tail<3>() =
            dynamics.rotation(body).transpose() *
            (dynamics.station_acceleration(body, p) + dynamics.station_jacobian(body, p) * a - kGravity);
        return both;
      };
      const Slopes expected = differences(felt, q, v);
      felt(q, v);
      TreeSlopes slopes;
      slopes.set(dynamics, a);
      TreeSlopes::Felt found;
      slopes.felt_at(body, dynamics.station(body, point), found);
      const Eigen::Matrix3d back = dynamics.rotation(body).transpose();
      const double size = 1.0 + expected.by_position.norm() + expected.by_velocity.norm();
      EXPECT_LT((back * found.turn_by_position - expected.by_position.topRows(3)).norm(), kNear * size);
      EXPECT_LT((back * found.pull_by_position - expected.by_position.bottomRows(3)).norm(), kNear * size);
      EXPECT_LT((back * found.pull_by_velocity - expected.by_velocity.bottomRows(3)).norm(), kNear * size);
    }
  }
}

// The same motion with another mass, centre of mass and inertia of one body.
TEST_P(TreeSlopesOf, AnotherMassNeedsWhatTheEquationsOfMotionSay) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    RandomTree random = tree(seed);
    const int n = random.coordinates;
    const auto draw = [&](double size) {
      return VectorXd(VectorXd::NullaryExpr(n, [&] { return size * random.number(); }));
    };
    const VectorXd q = draw(1.2), v = draw(2.0), a = draw(5.0);
    for (std::size_t body = 0; body < random.bodies.size(); ++body) {
      std::vector<TreeBody> bodies = random.bodies;
      TreeBody& other = bodies[body];
      other.mass += 0.7;
      other.com += 0.1 * random.vector();
      other.inertia += 0.2 * Eigen::Matrix3d::Identity();
      TreeDynamics dynamics(random.bodies, n, kGravity);
      TreeDynamics changed(bodies, n, kGravity);
      const VectorXd expected = forces(changed, q, v, a) - forces(dynamics, q, v, a);
      TreeSlopes slopes;
      slopes.set(dynamics, a);
      VectorXd found = VectorXd::Zero(n);
      slopes.add_other_mass(dynamics, static_cast<int>(body), other, found);
      EXPECT_LT((found - expected).norm(), 1e-10 * (1.0 + expected.norm())) << "tree " << seed;
      EXPECT_GT(expected.norm(), 1e-3);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Trees, TreeSlopesOf, testing::Values(true, false),
                         [](const auto& one) { return std::string(one.param ? "Floating" : "Fixed"); });

}  // namespace
}  // namespace plumbline::model
