// Systems with known solutions.
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "simulator/integrate/integrator.h"

namespace plumbline::integrate {

/// Kepler's problem with unit constants. From (1 - e, 0, 0, sqrt((1 + e)/(1 - e))) the orbit is an ellipse of
/// semi-axis 1 and eccentricity e with period 2 pi: Hairer, Lubich, Wanner, Geometric Numerical Integration,
/// I.2.
class Kepler : public Ode {
 public:
  int size() const override { return 4; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    const double r2 = x[0] * x[0] + x[1] * x[1];
    const double r3 = r2 * std::sqrt(r2);
    xdot[0] = x[2];
    xdot[1] = x[3];
    xdot[2] = -x[0] / r3;
    xdot[3] = -x[1] / r3;
  }
  static Eigen::VectorXd perihelion(double e) {
    return Eigen::Vector4d(1.0 - e, 0.0, 0.0, std::sqrt((1.0 + e) / (1.0 - e)));
  }
  /// The position at time t from Kepler's equation u - e sin u = t.
  static Eigen::Vector2d position(double e, double t) {
    double u = t;
    for (int i = 0; i < 50; ++i) u -= (u - e * std::sin(u) - t) / (1.0 - e * std::cos(u));
    return {std::cos(u) - e, std::sqrt(1.0 - e * e) * std::sin(u)};
  }
};

/// x'' = -w^2 x - 2 z w x' + w^2 u with a held input u.
class DrivenOscillator : public Ode {
 public:
  DrivenOscillator(double w, double z) : w_(w), z_(z) {}
  int size() const override { return 2; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    xdot[0] = x[1];
    xdot[1] = w_ * w_ * (u - x[0]) - 2.0 * z_ * w_ * x[1];
  }
  /// Closed form over a time t with the input held, underdamped (z < 1).
  Eigen::Vector2d exact(const Eigen::Vector2d& x, double t) const {
    const double d = w_ * std::sqrt(1.0 - z_ * z_);
    const double a = x[0] - u;
    const double b = (x[1] + z_ * w_ * a) / d;
    const double decay = std::exp(-z_ * w_ * t);
    const double c = std::cos(d * t);
    const double s = std::sin(d * t);
    return {u + decay * (a * c + b * s), decay * ((b * d - z_ * w_ * a) * c - (a * d + z_ * w_ * b) * s)};
  }
  double u = 0.0;

 private:
  double w_, z_;
};

/// The same with its Jacobian.
class DrivenOscillatorWithJacobian : public DrivenOscillator {
 public:
  DrivenOscillatorWithJacobian(double w, double z)
      : DrivenOscillator(w, z), stiffness_(w * w), rate_(2.0 * z * w) {}
  bool has_jacobian() const override { return true; }
  void jacobian(double /*t*/, const double* /*x*/, Eigen::Ref<Eigen::MatrixXd> J) override {
    J << 0.0, 1.0, -stiffness_, -rate_;
  }

 private:
  double stiffness_, rate_;
};

inline Options with(Method method, double tolerance) {
  Options options;
  options.method = method;
  options.relative_tolerance = tolerance;
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, tolerance);
  return options;
}

}  // namespace plumbline::integrate
