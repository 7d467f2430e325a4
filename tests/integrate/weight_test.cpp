// What the relative tolerance is relative to, and what an integrator says when it gives up.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

std::string named(const testing::TestParamInfo<Method>& tested) { return to_string(tested.param); }

class Weights : public testing::TestWithParam<Method> {};

/// x' = -x from 1: what is left at t = 10 is 4.5e-5 of the largest.
class Decay : public Ode {
 public:
  int size() const override { return 1; }
  void rate(double /*t*/, const double* x, double* xdot) override { xdot[0] = -x[0]; }
};

TEST_P(Weights, ByReachAskForNoMoreOfWhatHasDecayed) {
  Decay decay;
  Options options = with(GetParam(), 1e-6);
  options.absolute_tolerance = Eigen::VectorXd::Constant(1, 1e-14);
  const auto run = [&](Weight weight) {
    options.weight = weight;
    Integrator integrator(decay, options);
    integrator.start(0.0, Eigen::VectorXd::Constant(1, 1.0));
    integrator.advance(10.0);
    EXPECT_NEAR(integrator.state()[0], std::exp(-10.0), 1e-4);  // a hundred tolerances of the largest
    return integrator.summary().steps;
  };
  const long present = run(Weight::present);
  EXPECT_LT(run(Weight::reach), 0.8 * static_cast<double>(present));
}

/// The second state blows up at t = 1: x' = x^2 from 1 is 1/(1 - t).
class BlowUp : public Ode {
 public:
  int size() const override { return 2; }
  void rate(double /*t*/, const double* x, double* xdot) override {
    xdot[0] = 1.0;
    xdot[1] = x[1] * x[1];
  }
  std::string state_name(int state) const override { return state == 1 ? "what grows" : "what does not"; }
  std::string stiffest(double /*t*/, const double* /*x*/) override { return "the square"; }
};

TEST_P(Weights, AnIntegratorThatGivesUpNamesTimeStateAndElement) {
  BlowUp system;
  Integrator integrator(system, with(GetParam(), 1e-6));
  integrator.start(0.0, Eigen::Vector2d(0.0, 1.0));
  try {
    integrator.advance(2.0);
    FAIL() << "expected the singularity at 1 to be met";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::StartsWith(to_string(GetParam()) + " failed after t = "));
    EXPECT_NEAR(integrator.time(), 1.0, 1e-3);
    // bdf cannot solve for a step there, and so has no error to speak of.
    EXPECT_THAT(error.what(), testing::AnyOf(testing::HasSubstr("Largest local error: what "),
                                             testing::HasSubstr("Fastest against its tolerance: what ")));
    EXPECT_THAT(error.what(), testing::HasSubstr("Stiffest: the square."));
  }
}

TEST_P(Weights, TooManyStepsAreReportedTheSameWay) {
  BlowUp system;
  Options options = with(GetParam(), 1e-10);
  options.max_steps = 3;
  Integrator integrator(system, options);
  integrator.start(0.0, Eigen::Vector2d(0.0, 1.0));
  try {
    integrator.advance(0.9);
    FAIL() << "expected three steps to be too few";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("max_steps = 3"));
    EXPECT_THAT(error.what(), testing::HasSubstr("Largest local error: what grows."));
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Weights,
                         testing::Values(Method::bdf, Method::implicit_rk, Method::explicit_rk,
                                         Method::rosenbrock),
                         named);

/// Says that its first state is a position.
class WithPositions : public DrivenOscillatorWithJacobian {
 public:
  using DrivenOscillatorWithJacobian::DrivenOscillatorWithJacobian;
  int positions() const override { return 1; }
};

// The elimination of positions is exact: the same steps, to rounding.
TEST(Positions, EliminatedOrNotGiveTheSameSteps) {
  DrivenOscillatorWithJacobian whole(300.0, 0.3);
  WithPositions reduced(300.0, 0.3);
  whole.u = reduced.u = 1.0;
  Options options = with(Method::rosenbrock, 1e-6);
  Integrator one(whole, options);
  Integrator other(reduced, options);
  for (Integrator* integrator : {&one, &other}) {
    integrator->start(0.0, Eigen::Vector2d(0.2, -1.0));
    integrator->advance(0.05);
  }
  EXPECT_EQ(one.summary().steps, other.summary().steps);
  EXPECT_LT((one.state() - other.state()).norm(), 1e-11 * one.state().norm());
}

}  // namespace
}  // namespace plumbline::integrate
