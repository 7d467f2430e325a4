// A pendulum in Cartesian coordinates with its length as a constraint, against its angle.
#include <gtest/gtest.h>

#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

constexpr double kGravity = 9.81;

/// x, y, x', y' on the unit circle; the rod's force from the twice differentiated constraint (index 1):
/// force/mass = x'^2 + y'^2 - g y along the rod.
class CartesianPendulum : public Ode {
 public:
  explicit CartesianPendulum(bool projected) : projected_(projected) {}
  int size() const override { return 4; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    const double force = (x[2] * x[2] + x[3] * x[3] - kGravity * x[1]) / (x[0] * x[0] + x[1] * x[1]);
    xdot[0] = x[2];
    xdot[1] = x[3];
    xdot[2] = -force * x[0];
    xdot[3] = -force * x[1] - kGravity;
  }
  bool has_projection() const override { return projected_; }
  double project(double /*t*/, double* x) override {
    const double before = drift(Eigen::Map<Eigen::Vector4d>(x));
    const double r = std::hypot(x[0], x[1]);
    x[0] /= r;
    x[1] /= r;
    const double along = x[0] * x[2] + x[1] * x[3];
    x[2] -= along * x[0];
    x[3] -= along * x[1];
    return before;
  }
  /// Of length and of its derivative.
  static double drift(const Eigen::Vector4d& x) {
    return std::hypot(std::hypot(x[0], x[1]) - 1.0, x[0] * x[2] + x[1] * x[3]);
  }

 private:
  bool projected_;
};

/// The same in its minimal coordinate, the angle from the vertical.
class AnglePendulum : public Ode {
 public:
  int size() const override { return 2; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    xdot[0] = x[1];
    xdot[1] = -kGravity * std::sin(x[0]);
  }
};

constexpr double kTime = 20.0;

Eigen::Vector2d reference() {
  AnglePendulum pendulum;
  Integrator integrator(pendulum, with(Method::explicit_rk, 1e-13));
  integrator.start(0.0, Eigen::Vector2d(1.5707963267948966, 0.0));
  integrator.advance(kTime);
  const double angle = integrator.state()[0];
  return {std::sin(angle), -std::cos(angle)};
}

struct Outcome {
  double error, drift, largest_projection;
};

Outcome run(Method method, double tolerance, bool projected) {
  CartesianPendulum pendulum(projected);
  Integrator integrator(pendulum, with(method, tolerance));
  integrator.start(0.0, Eigen::Vector4d(1.0, 0.0, 0.0, 0.0));
  double drift = 0.0;
  for (int k = 1; k <= 200; ++k) {
    integrator.advance(kTime * k / 200);
    drift = std::max(drift, CartesianPendulum::drift(integrator.state()));
  }
  return {(integrator.state().head(2) - reference()).norm(), drift, integrator.summary().largest_projection};
}

class Projection : public testing::TestWithParam<Method> {};

TEST_P(Projection, KeepsTheConstraintAndFollowsTheTolerance) {
  double last = 10.0;
  for (const double tolerance : {1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    const Outcome outcome = run(GetParam(), tolerance, true);
    EXPECT_LT(outcome.error, 0.5 * last) << tolerance;
    EXPECT_LT(outcome.error, 3e3 * tolerance);
    EXPECT_LT(outcome.drift, 1e-12);
    EXPECT_GT(outcome.largest_projection, 1e-3 * tolerance);
    EXPECT_LT(outcome.largest_projection, 100.0 * tolerance);
    last = outcome.error;
  }
}

TEST_P(Projection, IsNeeded) { EXPECT_GT(run(GetParam(), 1e-6, false).drift, 1e-7); }

INSTANTIATE_TEST_SUITE_P(Methods, Projection,
                         testing::Values(Method::bdf, Method::implicit_rk, Method::explicit_rk),
                         [](const auto& tested) { return to_string(tested.param); });

}  // namespace
}  // namespace plumbline::integrate
