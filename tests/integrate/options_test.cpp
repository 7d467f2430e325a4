// Options that make no sense, and failures, are reported with what is needed to mend them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

template <class Error, class Action>
std::string message_of(Action action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing thrown";
}

std::string complaint(const std::function<void(Options&)>& spoil) {
  Options options;
  spoil(options);
  return message_of<std::invalid_argument>([&] { options.validate(); });
}

TEST(Options, DefaultsAreValid) { EXPECT_NO_THROW(Options().validate()); }

TEST(Options, ComplaintsNameOptionValueAndRange) {
  EXPECT_EQ(complaint([](Options& o) { o.order = 6; }),
            "integrator option order: found 6, expected 0 (the default) or 2 to 5 for explicit_rk");
  EXPECT_THAT(complaint([](Options& o) {
                o.order = -1;
                o.method = Method::bdf;
              }),
              HasSubstr("found -1, expected 0 (the default) or 1 to 5 for bdf"));
  EXPECT_EQ(complaint([](Options& o) { o.relative_tolerance = 0.0; }),
            "integrator option relative_tolerance: found 0, expected more than 0 and less than 1");
  EXPECT_THAT(complaint([](Options& o) { o.relative_tolerance = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("relative_tolerance: found nan"));
  EXPECT_EQ(complaint([](Options& o) { o.absolute_tolerance = Eigen::Vector2d(1e-9, -1.0); }),
            "integrator option absolute_tolerance[1]: found -1, expected a positive number");
  EXPECT_THAT(complaint([](Options& o) { o.max_step = -0.5; }),
              HasSubstr("max_step: found -0.5, expected 0"));
  EXPECT_THAT(complaint([](Options& o) { o.fixed_step = -1.0; }),
              HasSubstr("fixed_step: found -1, expected 0"));
  EXPECT_THAT(complaint([](Options& o) {
                o.fixed_step = 1e-3;
                o.method = Method::bdf;
              }),
              HasSubstr("fixed_step: found 0.001, expected 0 for bdf"));
  EXPECT_THAT(complaint([](Options& o) { o.max_steps = 0; }),
              HasSubstr("max_steps: found 0, expected at least 1"));
}

TEST(Options, TolerancesMustMatchTheStates) {
  DrivenOscillator system(1.0, 0.1);
  Options options;
  options.absolute_tolerance = Eigen::Vector3d::Constant(1e-9);
  EXPECT_THAT(
      message_of<std::invalid_argument>([&] { Integrator(system, options); }),
      HasSubstr("absolute_tolerance: found 3 values, expected none, one, or one for each of the 2 states"));
}

class Failure : public testing::TestWithParam<Method> {};

/// x' = x^2 from 1 is 1/(1 - t): no method gets past t = 1.
class Explosion : public Ode {
 public:
  int size() const override { return 1; }
  void rate(double /*t*/, const double* x, double* xdot) override { xdot[0] = x[0] * x[0]; }
};

TEST_P(Failure, NamesMethodTimeAndReasonAndPrintsNothing) {
  Explosion explosion;
  Integrator integrator(explosion, with(GetParam(), 1e-6));
  integrator.start(0.0, Eigen::VectorXd::Constant(1, 1.0));
  testing::internal::CaptureStderr();
  const std::string message = message_of<std::runtime_error>([&] { integrator.advance(2.0); });
  EXPECT_THAT(testing::internal::GetCapturedStderr(), IsEmpty());
  EXPECT_THAT(message, AllOf(HasSubstr(to_string(GetParam()) + " failed after t = "), HasSubstr(" s: ")));
  EXPECT_NEAR(integrator.time(), 1.0, 1e-3);
}

TEST_P(Failure, TooManySteps) {
  Kepler kepler;
  Options options = with(GetParam(), 1e-8);
  options.max_steps = 10;
  Integrator integrator(kepler, options);
  integrator.start(0.0, Kepler::perihelion(0.3));
  EXPECT_THAT(message_of<std::runtime_error>([&] { integrator.advance(100.0); }),
              HasSubstr("max_steps = 10 steps do not reach t = 100 s"));
}

TEST_P(Failure, GoingBack) {
  Kepler kepler;
  Integrator integrator(kepler, with(GetParam(), 1e-6));
  integrator.start(1.0, Kepler::perihelion(0.3));
  EXPECT_THAT(message_of<std::runtime_error>([&] { integrator.advance(0.5); }), HasSubstr("cannot go back"));
}

/// Throws in the middle of a step.
class Interrupted : public Kepler {
 public:
  void rate(double t, const double* x, double* xdot) override {
    if (t > 0.5) throw std::domain_error("stop here");
    Kepler::rate(t, x, xdot);
  }
};

TEST_P(Failure, ExceptionsOfTheOdePassThrough) {
  Interrupted interrupted;
  Integrator integrator(interrupted, with(GetParam(), 1e-6));
  integrator.start(0.0, Kepler::perihelion(0.3));
  EXPECT_EQ(message_of<std::domain_error>([&] { integrator.advance(1.0); }), "stop here");
}

TEST_P(Failure, DoesNotSpoilTheNextStart) {
  Kepler kepler;
  Options options = with(GetParam(), 1e-8);
  options.max_steps = 500;
  Integrator integrator(kepler, options);
  integrator.start(0.0, Kepler::perihelion(0.3));
  EXPECT_THROW(integrator.advance(1000.0), std::runtime_error);
  integrator.start(0.0, Kepler::perihelion(0.3));
  integrator.advance(0.5);
  EXPECT_LT((integrator.state().head(2) - Kepler::position(0.3, 0.5)).norm(), 1e-6);
}

/// sqrt of a state that falls to zero and would become negative at long steps: x' = -2 sqrt(x) gives (1 -
/// t)^2.
class Draining : public Ode {
 public:
  int size() const override { return 1; }
  void rate(double /*t*/, const double* x, double* xdot) override { xdot[0] = -2.0 * std::sqrt(x[0]); }
};

TEST_P(Failure, RatesThatAreNotFiniteShortenTheStep) {
  Draining draining;
  Integrator integrator(draining, with(GetParam(), 1e-8));
  integrator.start(0.0, Eigen::VectorXd::Constant(1, 1.0));
  integrator.advance(0.99);
  EXPECT_NEAR(integrator.state()[0], 1e-4, 1e-6);
  EXPECT_THAT(message_of<std::runtime_error>([&] { integrator.advance(2.0); }), HasSubstr("not finite"));
}

INSTANTIATE_TEST_SUITE_P(Methods, Failure,
                         testing::Values(Method::bdf, Method::implicit_rk, Method::explicit_rk,
                                         Method::rosenbrock),
                         [](const auto& tested) { return to_string(tested.param); });

}  // namespace
}  // namespace plumbline::integrate
