#include "validation/identify/predict/eliminate.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

namespace plumbline::validation {
namespace {

constexpr Eigen::Index kRows = 40, kStates = 3, kParameters = 2;

/// X = U A, J = U C + V B and r = U a + V b with orthonormal U and V: what is left without x is
/// |V b - V B p|^2.
struct Known {
  Eigen::MatrixXd A, B, C;
  Eigen::VectorXd a, b;
  Eigen::MatrixXd basis =
      Eigen::MatrixXd::Random(kRows, kStates + kParameters).householderQr().householderQ() *
      Eigen::MatrixXd::Identity(kRows, kStates + kParameters);
  Eigen::MatrixXd U() const { return basis.leftCols(kStates); }
  Eigen::MatrixXd V() const { return basis.rightCols(kParameters); }
  Eliminated found() const { return eliminate(U() * A, U() * C + V() * B, U() * a + V() * b); }
};

/// Errors of a state's first direction grow by `expansion`, and the parameters act through it, too.
Known expanding(double expansion) {
  Known one;
  one.A = Eigen::Vector3d(expansion, 3.0, 0.2).asDiagonal();
  one.A(0, 1) = 0.5 * expansion;
  one.B = (Eigen::MatrixXd(2, 2) << 1.0, 0.4, -0.3, 2.0).finished();
  one.C = (Eigen::MatrixXd(3, 2) << 0.7 * expansion, -0.4 * expansion, 1.0, 2.0, 3.0, -1.0).finished();
  one.a = Eigen::Vector3d(3.0, 1.0, -2.0);
  one.b = Eigen::Vector2d(0.6, -1.1);
  return one;
}

void expect_what_is_left(const Known& one, double tolerance) {
  const Eliminated found = one.found();
  EXPECT_LT((found.H - one.B.transpose() * one.B).norm(), tolerance * found.H.norm());
  EXPECT_LT((found.g - one.B.transpose() * one.b).norm(), tolerance * found.g.norm());
  EXPECT_NEAR(found.sse, one.b.squaredNorm(), tolerance);
  EXPECT_LT((found.r - one.V() * one.b).norm(), tolerance);
  EXPECT_LT((one.A * found.step - one.a).norm(), tolerance * one.a.norm());
  EXPECT_LT((one.A * found.slope - one.C).norm(), tolerance * one.C.norm());
}

TEST(Eliminate, LeavesWhatTheOthersCannotExplain) { expect_what_is_left(expanding(1.0), 1e-12); }

// As through the stiff contacts of a landing: |J|^2 is 1e22, of which 1 is left.
TEST(Eliminate, LeavesItOfSlopesThatAreVeryLong) { expect_what_is_left(expanding(1e11), 1e-3); }

TEST(Eliminate, WithoutOtherUnknownsFindsTheStep) {
  Known one = expanding(1.0);
  one.B.resize(2, 0);
  one.C.resize(3, 0);
  const Eliminated found = eliminate(one.U() * one.A, Eigen::MatrixXd(kRows, 0), one.U() * one.a);
  EXPECT_LT((one.A * found.step - one.a).norm(), 1e-12 * one.a.norm());
  EXPECT_EQ(found.H.size(), 0);
}

}  // namespace
}  // namespace plumbline::validation
