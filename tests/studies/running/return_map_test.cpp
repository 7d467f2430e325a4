// The outer loop's gains beside the scalar Riccati equation's closed form.
#include "validation/studies/running/return_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace plumbline::running_tests {
namespace {

using validation::LinearReturn;
using validation::OuterLoopWeights;

// x' = a x + b u at the cost x^2/s^2 + u^2/t^2: with q = b^2 t^2/s^2, p = P s^2 solves p^2 - p (a^2 - 1 +
// q)/q - 1/q = 0.
TEST(OuterLoop, IsTheScalarRegulatorWhereOneDirectionMoves) {
  constexpr double a = 1.2, b = 0.7, s = 0.1, t = 0.02;
  LinearReturn map;
  map.by_state.setZero();
  map.by_beta.setZero();
  map.by_state(2, 2) = a;
  map.by_beta(2, 1) = b;
  OuterLoopWeights weights;
  weights.state.setConstant(s);
  weights.parameter.setConstant(t);
  const auto gain = validation::outer_loop(map, weights);
  const double q = b * b * t * t / (s * s), half = 0.5 * (a * a - 1.0 + q) / q;
  const double p = half + std::sqrt(half * half + 1.0 / q);
  EXPECT_NEAR(gain(1, 2), -a * q * p / (b * (1.0 + q * p)), 1e-10);
  EXPECT_NEAR(gain.norm(), std::abs(gain(1, 2)), 1e-12);
  EXPECT_NEAR(validation::multipliers(map.by_state + map.by_beta * gain).front(), a / (1.0 + q * p), 1e-10);
}

TEST(OuterLoop, SaysWhereNothingHelps) {
  LinearReturn map;
  map.by_state.setIdentity();
  map.by_state *= 1.1;
  map.by_beta.setZero();
  EXPECT_THROW(validation::outer_loop(map, OuterLoopWeights()), std::runtime_error);
}

}  // namespace
}  // namespace plumbline::running_tests
