#include "validation/studies/recipes/estimators.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <stdexcept>

namespace plumbline::validation {

Regression least_squares(const Eigen::MatrixXd& X, const Eigen::VectorXd& y) {
  Regression result;
  result.degrees_of_freedom = static_cast<int>(X.rows() - X.cols());
  if (result.degrees_of_freedom < 1) {
    throw std::invalid_argument("least squares: no more rows than columns");
  }
  result.values = X.colPivHouseholderQr().solve(y);
  const double variance = (y - X * result.values).squaredNorm() / result.degrees_of_freedom;
  result.covariance =
      variance * (X.transpose() * X).ldlt().solve(Eigen::MatrixXd::Identity(X.cols(), X.cols()));
  return result;
}

Regression first_order_arx(const Eigen::VectorXd& velocity, const Eigen::VectorXd& command, double period) {
  const Eigen::Index n = velocity.size() - 1;
  Eigen::MatrixXd X(n, 3);
  X << velocity.head(n), command.head(n), Eigen::VectorXd::Ones(n);
  const Regression arx = least_squares(X, velocity.tail(n));
  const double a = arx.values[0];
  const double b1 = arx.values[1];
  const double b2 = arx.values[2];
  if (!(a > 0.0 && a < 1.0)) {
    throw std::runtime_error("the motor's velocity does not decay: equation S1 has no friction to find");
  }
  const double mu = (1.0 - a) / b1;
  const double log_a = std::log(a);
  Regression result;
  result.degrees_of_freedom = arx.degrees_of_freedom;
  result.values = Eigen::Vector3d(b2 / b1, -mu * period / log_a, mu);
  Eigen::Matrix3d slopes;                    // d(bias, J, mu)/d(a, b1, b2)
  slopes << 0.0, -b2 / (b1 * b1), 1.0 / b1,  //
      period / (b1 * log_a) + mu * period / (a * log_a * log_a), mu * period / (b1 * log_a), 0.0,  //
      -1.0 / b1, -mu / b1, 0.0;
  result.covariance = slopes * arx.covariance * slopes.transpose();
  return result;
}

Regression equation_14(double rotor, const Eigen::VectorXd& pulleys, const Eigen::VectorXd& lumped,
                       const Eigen::VectorXd& deviations) {
  const Eigen::VectorXd weights = deviations.cwiseInverse();
  Eigen::MatrixXd G(lumped.size(), 2);
  G << weights * rotor, weights.cwiseProduct(pulleys);
  const Eigen::VectorXd products = G.colPivHouseholderQr().solve(weights.cwiseProduct(lumped));
  const Eigen::Matrix2d covariance = (G.transpose() * G).ldlt().solve(Eigen::Matrix2d::Identity());
  const double torque = products[1];
  const double both = products[0];
  Regression result;
  result.degrees_of_freedom = static_cast<int>(lumped.size()) - 2;
  result.values = Eigen::Vector2d(torque, both / torque);
  Eigen::Matrix2d slopes;  // d(alpha_torque, alpha_rotor)/d(products)
  slopes << 0.0, 1.0, 1.0 / torque, -both / (torque * torque);
  result.covariance = slopes * covariance * slopes.transpose();
  return result;
}

Regression equation_22(const Eigen::VectorXd& shape, const Eigen::VectorXd& spring,
                       const Eigen::VectorXd& weight, double ratio) {
  Eigen::MatrixXd X(spring.size(), 2);
  X << spring, Eigen::VectorXd::Ones(spring.size());
  const Eigen::VectorXd torque = weight.cwiseProduct(shape.array().sin().abs().matrix()) / ratio;
  return least_squares(X, torque);
}

Eigen::VectorXd every_nth(const Eigen::VectorXd& values, Eigen::Index every) {
  Eigen::VectorXd picked((values.size() + every - 1) / every);
  for (Eigen::Index i = 0; i < picked.size(); ++i) {
    picked[i] = values[i * every];
  }
  return picked;
}

Eigen::VectorXd group_means(const Eigen::VectorXd& values, Eigen::Index every) {
  Eigen::VectorXd means((values.size() + every - 1) / every);
  for (Eigen::Index i = 0; i < means.size(); ++i) {
    means[i] = values.segment(i * every, std::min(every, values.size() - i * every)).mean();
  }
  return means;
}

}  // namespace plumbline::validation
