#include "controllers/monopod/bezier.h"

#include <gtest/gtest.h>

namespace plumbline::running_tests {
namespace {

using monopod::bezier;
using monopod::Coefficients;
using monopod::Curve;

// The sum of Bernstein polynomials, as the paper's equation 8 states them.
double bernstein(const Coefficients& a, double s) {
  const double binomial[] = {1, 6, 15, 20, 15, 6, 1};
  double sum = 0.0;
  for (int k = 0; k <= 6; ++k) {
    sum += binomial[k] * std::pow(s, k) * std::pow(1.0 - s, 6 - k) * a[static_cast<std::size_t>(k)];
  }
  return sum;
}

TEST(Bezier, IsTheSumOfBernsteinPolynomials) {
  const Coefficients a{0.3, -0.2, 1.4, 0.7, -2.0, 0.1, 0.9};
  constexpr double h = 1e-4;
  for (double s = 0.05; s < 1.0; s += 0.1) {
    const Curve curve = bezier(a, s);
    EXPECT_NEAR(curve.value, bernstein(a, s), 1e-13);
    EXPECT_NEAR(curve.slope, (bernstein(a, s + h) - bernstein(a, s - h)) / (2 * h), 1e-5);
    EXPECT_NEAR(curve.bend, (bernstein(a, s + h) - 2 * bernstein(a, s) + bernstein(a, s - h)) / (h * h),
                1e-3);
  }
}

TEST(Bezier, GoesOnSmoothlyIntoAStraightLine) {
  const Coefficients a{0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.5};
  constexpr double h = 1e-5;
  for (const double s : {-0.3, -0.1, -0.04, -1e-9, 1.0, 1.03, 1.0999, 1.2}) {
    const Curve below = bezier(a, s - h), curve = bezier(a, s), above = bezier(a, s + h);
    EXPECT_NEAR(curve.slope, (above.value - below.value) / (2 * h), 1e-3) << s;
    EXPECT_NEAR(curve.bend, (above.slope - below.slope) / (2 * h), 1e-2) << s;
    EXPECT_NEAR(above.bend, below.bend, 0.02) << s;
  }
  EXPECT_DOUBLE_EQ(bezier(a, 2.0).bend, 0.0);
  EXPECT_DOUBLE_EQ(bezier(a, 3.0).value - bezier(a, 2.0).value, bezier(a, 2.0).slope);
  EXPECT_DOUBLE_EQ(bezier(a, -2.0).value - bezier(a, -1.0).value, -bezier(a, -1.0).slope);
}

}  // namespace
}  // namespace plumbline::running_tests
