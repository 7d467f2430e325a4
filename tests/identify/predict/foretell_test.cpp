#include "validation/identify/predict/foretell.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

namespace plumbline::validation {
namespace {

/// Normal equations of residuals y - J d.
Sum sum_of_lines(const Eigen::MatrixXd& J, const Eigen::VectorXd& y) {
  return {J.transpose() * J, J.transpose() * y, y.squaredNorm(), static_cast<double>(y.size())};
}

Room wide(Eigen::Index n) {
  const double infinity = std::numeric_limits<double>::infinity();
  return {Eigen::VectorXd::Constant(n, -infinity), Eigen::VectorXd::Constant(n, infinity)};
}

Prior nothing_known(Eigen::Index n) { return {0.0, Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)}; }

// Large numbers: the search's own weak prior is then nothing.
class Lines : public testing::Test {
 protected:
  Eigen::MatrixXd train_ = 300.0 * (Eigen::MatrixXd(4, 2) << 1, 0.4, -0.3, 1, 0.8, 0.8, 0.1, -0.6).finished();
  Eigen::VectorXd y_ = 300.0 * (Eigen::VectorXd(4) << 0.3, 1.2, -0.5, 0.7).finished();
  Eigen::MatrixXd held_out_ = 300.0 * (Eigen::MatrixXd(3, 2) << 0.2, 1.5, -1.1, 0.4, 0.9, 0.9).finished();
  Eigen::VectorXd z_ = 300.0 * (Eigen::VectorXd(3) << 1.4, 0.2, -0.8).finished();
};

// Bishop 2006, equation 3.59: covariance of what is predicted is the noise's and the slopes' times what is
// not known of the parameters.
TEST_F(Lines, AreForetoldAsThePredictiveDistributionSays) {
  const Eigen::Matrix2d known = (Eigen::Matrix2d() << 4e4, -2e4, -2e4, 9e4).finished();
  const Eigen::Matrix2d precision = train_.transpose() * train_ + known;
  const Eigen::Vector2d best = precision.inverse() * train_.transpose() * y_;
  const Eigen::Matrix3d covariance =
      Eigen::Matrix3d::Identity() + held_out_ * precision.inverse() * held_out_.transpose();
  const Eigen::Vector3d residual = z_ - held_out_ * best;
  const Foretold foretold = foretell(sum_of_lines(train_, y_), sum_of_lines(held_out_, z_),
                                     {0.0, Eigen::Vector2d::Zero(), known}, wide(2));
  EXPECT_TRUE(foretold.train_step.isApprox(best, 1e-6));
  EXPECT_NEAR(foretold.held_out, residual.dot(covariance.inverse() * residual), 1e-6 * foretold.held_out);
  EXPECT_LT(foretold.held_out, residual.squaredNorm());
}

TEST_F(Lines, ThatLeaveNothingOpenAreHeldAgainstTheirBestValues) {
  const Eigen::Vector2d best = (1e4 * train_).colPivHouseholderQr().solve(1e4 * y_);
  const Foretold foretold =
      foretell(sum_of_lines(1e4 * train_, 1e4 * y_), sum_of_lines(held_out_, z_), nothing_known(2), wide(2));
  EXPECT_NEAR(foretold.held_out, (z_ - held_out_ * best).squaredNorm(), 1e-3 * foretold.held_out);
}

// A direction that the train lines do not see at all may be chosen by the held-out ones.
TEST_F(Lines, ThatLeaveADirectionOpenDoNotChargeForIt) {
  Eigen::MatrixXd blind = train_;
  blind.col(1).setZero();
  const double slope = blind.col(0).dot(y_) / blind.col(0).squaredNorm();
  const Eigen::VectorXd left = z_ - held_out_.col(0) * slope;
  const Foretold foretold =
      foretell(sum_of_lines(blind, y_), sum_of_lines(held_out_, z_), nothing_known(2), wide(2));
  EXPECT_NEAR(foretold.train, (y_ - blind.col(0) * slope).squaredNorm(), 1e-6 * foretold.train);
  const double best_for_second =
      (left - held_out_.col(1) * held_out_.col(1).dot(left) / held_out_.col(1).squaredNorm()).squaredNorm();
  EXPECT_LE(foretold.held_out, best_for_second * (1.0 + 1e-6));
}

TEST_F(Lines, MoveWithinTheirBounds) {
  const Room narrow{Eigen::Vector2d(-0.1, 0.0), Eigen::Vector2d(0.1, 0.0)};
  const Foretold foretold =
      foretell(sum_of_lines(train_, y_), sum_of_lines(held_out_, z_), nothing_known(2), narrow);
  EXPECT_LE(foretold.step.cwiseAbs()[0], 0.1);
  EXPECT_EQ(foretold.step[1], 0.0);
}

}  // namespace
}  // namespace plumbline::validation
