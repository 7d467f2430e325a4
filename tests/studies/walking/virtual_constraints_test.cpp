// Bezier polynomials against their closed forms, and the order of a step's phases.
#include "controllers/blocks/virtual_constraints.h"

#include <gtest/gtest.h>

namespace plumbline::controllers {
namespace {

// Coefficients k/5 give the straight line s; k(k-1)/20 the parabola s^2 (degree elevation).
TEST(Curve, IsTheLineAndTheParabolaThatItsCoefficientsSay) {
  Curve line{2.0, 6.0, {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}};
  Curve parabola{2.0, 6.0, {0.0, 0.0, 0.1, 0.3, 0.6, 1.0}};
  for (const double theta : {2.0, 2.7, 4.0, 5.9, 6.0}) {
    const double s = (theta - 2.0) / 4.0;
    const CurvePoint a = evaluate(line, theta, false);
    const CurvePoint b = evaluate(parabola, theta, false);
    EXPECT_NEAR(a.value, s, 1e-15);
    EXPECT_NEAR(a.slope, 0.25, 1e-15);
    EXPECT_NEAR(a.curvature, 0.0, 1e-14);
    EXPECT_NEAR(b.value, s * s, 1e-15);
    EXPECT_NEAR(b.slope, 2.0 * s / 4.0, 1e-15);
    EXPECT_NEAR(b.curvature, 2.0 / 16.0, 1e-14);
  }
}

TEST(Curve, StaysOrGoesOnBeyondItsEnds) {
  Curve line{0.0, 1.0, {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}};
  EXPECT_DOUBLE_EQ(evaluate(line, 1.5, false).value, 1.0);
  EXPECT_DOUBLE_EQ(evaluate(line, 1.5, false).slope, 0.0);
  EXPECT_DOUBLE_EQ(evaluate(line, 1.5, true).value, 1.5);
  EXPECT_DOUBLE_EQ(evaluate(line, -0.5, true).value, -0.5);
  EXPECT_DOUBLE_EQ(evaluate(line, -0.5, true).slope, 1.0);
}

WalkingGait gait() {
  WalkingGait it;
  it.theta_begin = -0.3;
  it.theta_mc = -0.25;
  it.theta_sc = -0.2;
  it.theta_si = 0.1;
  it.theta_end = 0.3;
  it.spring_switch = 0.09;
  it.shape_mc.alpha = {1.0, 1.0, 1.2, 1.5, 2.0, 2.0};
  it.shape_si.alpha = {2.0, 2.0, 1.0, 1.0, 0.5, 0.5};
  it.torso.alpha = {0.1, 0.1, 0.0, 0.0, -0.1, -0.1};
  place_curves(it);
  return it;
}

TEST(WalkPhase, FollowsThetaAndTheSpring) {
  const WalkingGait it = gait();
  const auto next = [&](WalkPhase phase, double theta, double spring, double rate) {
    return next_phase(it, phase, theta, spring, rate, 0.06);
  };
  EXPECT_EQ(next(WalkPhase::motor_compress, -0.26, 0.2, 1.0), WalkPhase::motor_compress);
  EXPECT_EQ(next(WalkPhase::motor_compress, -0.25, 0.2, 1.0), WalkPhase::spring_compress);
  // A spring that is still being pressed in does not end sc, however little it is deflected.
  EXPECT_EQ(next(WalkPhase::spring_compress, -0.24, 0.05, 1.0), WalkPhase::spring_compress);
  EXPECT_EQ(next(WalkPhase::spring_compress, -0.24, 0.05, -1.0), WalkPhase::spring_inject);
  // A spring that does not fall ends it at theta_mc + 0.06.
  EXPECT_EQ(next(WalkPhase::spring_compress, -0.20, 0.3, 1.0), WalkPhase::spring_compress);
  EXPECT_EQ(next(WalkPhase::spring_compress, -0.18, 0.3, 1.0), WalkPhase::spring_inject);
  EXPECT_EQ(next(WalkPhase::spring_inject, 0.1, 0.0, 0.0), WalkPhase::spring_decompress);
}

// Motions are continuous where one phase ends and the next begins; the motor is held in sc and sd.
TEST(Wanted, IsContinuousAcrossPhases) {
  const WalkingGait it = gait();
  const auto at = [&](WalkPhase phase, double theta) { return wanted(it, phase, theta); };
  EXPECT_DOUBLE_EQ(at(WalkPhase::motor_compress, -0.25)[kStanceShape].value,
                   at(WalkPhase::spring_compress, -0.25)[kStanceShape].value);
  EXPECT_DOUBLE_EQ(at(WalkPhase::spring_compress, -0.2)[kStanceShape].value,
                   at(WalkPhase::spring_inject, -0.2)[kStanceShape].value);
  EXPECT_DOUBLE_EQ(at(WalkPhase::spring_compress, -0.22)[kStanceShape].slope, 0.0);
  EXPECT_DOUBLE_EQ(at(WalkPhase::spring_decompress, 0.2)[kStanceShape].value, 0.5);
  EXPECT_DOUBLE_EQ(at(WalkPhase::spring_inject, 0.1)[kTorso].value,
                   at(WalkPhase::spring_decompress, 0.1)[kTorso].value);
}

TEST(GaitNumbers, HaveNamesOfTheirOwnAndReachEveryCurve) {
  WalkingGait it;
  std::vector<GaitNumber> numbers = numbers_of(it);
  EXPECT_EQ(numbers.size(), 6u + 5u * 6u + 16u * 6u);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    *numbers[i].value = static_cast<double>(i);
    for (std::size_t k = 0; k < i; ++k) ASSERT_NE(numbers[k].name, numbers[i].name);
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) ASSERT_EQ(*numbers[i].value, static_cast<double>(i));
}

}  // namespace
}  // namespace plumbline::controllers
