// Attained order with fixed steps, and error against tolerance without, on Kepler's problem.
#include <gtest/gtest.h>

#include <vector>

#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

constexpr double kPi = 3.14159265358979323846;

double error_after(double time, double eccentricity, const Options& options) {
  Kepler kepler;
  Integrator integrator(kepler, options);
  integrator.start(0.0, Kepler::perihelion(eccentricity));
  integrator.advance(time);
  return (integrator.state().head(2) - Kepler::position(eccentricity, time)).norm();
}

struct Attained {
  Method method;
  int order;
  int steps;  ///< on the coarser grid
};

class Order : public testing::TestWithParam<Attained> {};

// p = log2(e(h) / e(h/2)) for h in the asymptotic range.
TEST_P(Order, IsAttained) {
  const Attained& expected = GetParam();
  Options options = with(expected.method, 1e-3);
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-13);  // of the stages' Newton iteration
  options.relative_tolerance = 1e-13;
  options.order = expected.order;
  const double time = 3.0;
  options.fixed_step = time / expected.steps;
  const double coarse = error_after(time, 0.3, options);
  options.fixed_step = time / (2 * expected.steps);
  const double fine = error_after(time, 0.3, options);
  EXPECT_NEAR(std::log2(coarse / fine), expected.order, 0.25) << coarse << " " << fine;
}

INSTANTIATE_TEST_SUITE_P(
    RungeKutta, Order,
    testing::Values(Attained{Method::explicit_rk, 2, 3000}, Attained{Method::explicit_rk, 3, 1000},
                    Attained{Method::explicit_rk, 4, 300}, Attained{Method::explicit_rk, 5, 150},
                    Attained{Method::implicit_rk, 2, 3000}, Attained{Method::implicit_rk, 3, 600},
                    Attained{Method::implicit_rk, 4, 200}, Attained{Method::implicit_rk, 5, 100},
                    Attained{Method::rosenbrock, 3, 600}),
    [](const testing::TestParamInfo<Attained>& tested) {
      return to_string(tested.param.method) + std::to_string(tested.param.order);
    });

/// Kepler's problem with a Jacobian that is none: a W-method keeps its order.
class WrongJacobian : public Kepler {
 public:
  bool has_jacobian() const override { return true; }
  void jacobian(double /*t*/, const double* x, Eigen::Ref<Eigen::MatrixXd> J) override {
    J.setConstant(0.3);
    J(0, 2) = 1.0 + 0.2 * x[0];
    J(3, 1) = -0.7;
  }
};

TEST(Order, OfALinearlyImplicitMethodNeedsNoExactJacobian) {
  WrongJacobian kepler;
  const auto error = [&](int steps) {
    Options options = with(Method::rosenbrock, 1e-3);
    options.fixed_step = 3.0 / steps;
    Integrator integrator(kepler, options);
    integrator.start(0.0, Kepler::perihelion(0.3));
    integrator.advance(3.0);
    return (integrator.state().head(2) - Kepler::position(0.3, 3.0)).norm();
  };
  const double coarse = error(600);
  EXPECT_NEAR(std::log2(coarse / error(1200)), 3.0, 0.25) << coarse;
}

/// x' = -k (x - cos t) - sin t: the solution is cos t, however stiff.
class StiffFollower : public Ode {
 public:
  int size() const override { return 1; }
  void rate(double t, const double* x, double* xdot) override {
    xdot[0] = -1e6 * (x[0] - std::cos(t)) - std::sin(t);
  }
  bool has_jacobian() const override { return true; }
  void jacobian(double /*t*/, const double* /*x*/, Eigen::Ref<Eigen::MatrixXd> J) override { J(0, 0) = -1e6; }
};

TEST(Order, AStiffProblemNeedsNoSmallSteps) {
  StiffFollower follower;
  Integrator integrator(follower, with(Method::rosenbrock, 1e-6));
  integrator.start(0.0, Eigen::VectorXd::Constant(1, 1.0));
  integrator.advance(3.0);
  EXPECT_NEAR(integrator.state()[0], std::cos(3.0), 1e-6);
  EXPECT_LT(integrator.summary().steps, 2000);  // an explicit method needs a million
}

TEST(Order, DefaultsAreAsDocumented) {
  Options options = with(Method::explicit_rk, 1e-13);
  for (const auto& [method, order] : {std::pair(Method::explicit_rk, 5), std::pair(Method::implicit_rk, 4)}) {
    options.method = method;
    options.fixed_step = 0.02;
    options.order = 0;
    const double by_default = error_after(3.0, 0.3, options);
    options.order = order;
    EXPECT_EQ(by_default, error_after(3.0, 0.3, options));
  }
}

class Tolerance : public testing::TestWithParam<Method> {};

TEST_P(Tolerance, ErrorFollowsIt) {
  double last = 1.0;
  for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
    const double error = error_after(2.0 * kPi, 0.3, with(GetParam(), tolerance));
    EXPECT_LT(error, (GetParam() == Method::bdf ? 5000.0 : 500.0) * tolerance);
    EXPECT_GT(error, 1e-3 * tolerance);  // no more work than asked for
    EXPECT_LT(error, 0.2 * last);
    last = error;
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Tolerance,
                         testing::Values(Method::bdf, Method::implicit_rk, Method::explicit_rk,
                                         Method::rosenbrock),
                         [](const auto& tested) { return to_string(tested.param); });

}  // namespace
}  // namespace plumbline::integrate
