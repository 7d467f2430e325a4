// Held inputs: what happens at their jumps, and that runs repeat bit by bit.
#include <gtest/gtest.h>

#include "tests/integrate/problems.h"

namespace plumbline::integrate {
namespace {

struct Held {
  Method method;
  bool keep_history;
};

class Input : public testing::TestWithParam<Held> {};

/// 100 half periods of 7.3 ms of a square wave; uneven, so that no step size fits by luck.
template <class System>
Eigen::Vector2d drive(System& system, Integrator& integrator, bool keep_history, Eigen::Vector2d* exact) {
  *exact = Eigen::Vector2d(0.1, 0.0);
  integrator.start(0.0, *exact);
  const double half = 7.3e-3;
  for (int k = 0; k < 100; ++k) {
    system.u = k % 2 == 0 ? 1.0 : -1.0;
    integrator.input_changed(keep_history);
    integrator.advance(half * (k + 1));
    *exact = system.exact(*exact, half);
  }
  return integrator.state();
}

TEST_P(Input, SquareWaveAgreesWithTheClosedForm) {
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    DrivenOscillator system(60.0, 0.1);
    Integrator integrator(system, with(GetParam().method, tolerance));
    Eigen::Vector2d exact;
    const Eigen::Vector2d found = drive(system, integrator, GetParam().keep_history, &exact);
    // Velocities are about 60 times the positions.
    EXPECT_LT(std::abs(found[0] - exact[0]), 100.0 * tolerance) << tolerance;
    EXPECT_LT(std::abs(found[1] - exact[1]), 6000.0 * tolerance) << tolerance;
  }
}

TEST_P(Input, JacobianOrDifferencesGiveTheSame) {
  DrivenOscillator plain(60.0, 0.1);
  DrivenOscillatorWithJacobian with_jacobian(60.0, 0.1);
  Integrator a(plain, with(GetParam().method, 1e-8));
  Integrator b(with_jacobian, with(GetParam().method, 1e-8));
  Eigen::Vector2d exact;
  const Eigen::Vector2d difference = drive(plain, a, GetParam().keep_history, &exact) -
                                     drive(with_jacobian, b, GetParam().keep_history, &exact);
  EXPECT_LT(std::abs(difference[0]), 1e-6);
  if (GetParam().method != Method::bdf) {
    EXPECT_EQ(a.summary().restarts, 0);
  } else if (!GetParam().keep_history) {
    EXPECT_EQ(a.summary().restarts, 99);  // the first change is at the start
  }
  if (GetParam().method != Method::explicit_rk) {
    EXPECT_GT(b.summary().jacobian_evaluations, 0);
    EXPECT_LT(b.summary().rate_evaluations, a.summary().rate_evaluations);
  }
}

TEST_P(Input, RunsRepeatBitByBit) {
  DrivenOscillator system(60.0, 0.1);
  Integrator integrator(system, with(GetParam().method, 1e-7));
  Eigen::Vector2d exact;
  const Eigen::Vector2d first = drive(system, integrator, GetParam().keep_history, &exact);
  const Summary before = integrator.summary();
  const Eigen::Vector2d again = drive(system, integrator, GetParam().keep_history, &exact);
  EXPECT_EQ(first, again);
  EXPECT_EQ(before.steps, integrator.summary().steps);
  EXPECT_EQ(before.rate_evaluations, integrator.summary().rate_evaluations);
  Integrator other(system, with(GetParam().method, 1e-7));
  EXPECT_EQ(first, drive(system, other, GetParam().keep_history, &exact));
}

INSTANTIATE_TEST_SUITE_P(Methods, Input,
                         testing::Values(Held{Method::bdf, true}, Held{Method::bdf, false},
                                         Held{Method::implicit_rk, true}, Held{Method::explicit_rk, true},
                                         Held{Method::rosenbrock, true}),
                         [](const auto& tested) {
                           return to_string(tested.param.method) +
                                  (tested.param.keep_history ? "" : "_restarted");
                         });

// Each millisecond one step is enough: one evaluation for each stage, none for the restart.
TEST(InputCost, ExplicitMethodEvaluatesOnlyItsStages) {
  DrivenOscillator system(1.0, 0.1);
  Integrator integrator(system, with(Method::explicit_rk, 1e-6));
  integrator.start(0.0, Eigen::Vector2d(0.1, 0.0));
  integrator.advance(1.0);
  const long before = integrator.summary().rate_evaluations;
  for (int k = 0; k < 100; ++k) {
    system.u = k % 2 == 0 ? 1.0 : 0.9;
    integrator.input_changed(true);
    integrator.advance(1.0 + 1e-3 * (k + 1));
  }
  EXPECT_EQ(integrator.summary().rate_evaluations - before, 600);
}

// A stop that leaves almost nothing must not make the steps behind it short.
TEST(InputCost, ShortStretchesDoNotShortenTheSteps) {
  DrivenOscillator system(1.0, 0.1);
  Integrator integrator(system, with(Method::explicit_rk, 1e-6));
  integrator.start(0.0, Eigen::Vector2d(0.1, 0.0));
  integrator.advance(1.0);
  const long before = integrator.summary().steps;
  for (int k = 0; k < 100; ++k) {
    const double t = 1.0 + 1e-2 * k;
    integrator.input_changed(true);
    integrator.advance(t + 1e-9);
    integrator.input_changed(true);
    integrator.advance(t + 1e-2);
  }
  EXPECT_LE(integrator.summary().steps - before, 200);
}

}  // namespace
}  // namespace plumbline::integrate
