// Bezier polynomials of order 6 (the paper's equations 7, 8).
#pragma once

#include <array>

namespace plumbline::monopod {

constexpr int kOrder = 6;
using Coefficients = std::array<double, kOrder + 1>;

/// Value and derivatives by s.
struct Curve {
  double value = 0.0, slope = 0.0, bend = 0.0;
};

/// Within 0..1 the polynomial; outside it goes on in a straight line.
inline Curve bezier(const Coefficients& a, double s) {
  const double inside = s < 0.0 ? 0.0 : (s > 1.0 ? 1.0 : s);
  // De Casteljau: stop two and one stages before the end for the derivatives.
  Coefficients b = a;
  Curve curve;
  for (int left = kOrder; left > 0; --left) {
    if (left == 2) {
      curve.bend = kOrder * (kOrder - 1) * (b[2] - 2.0 * b[1] + b[0]);
    }
    if (left == 1) {
      curve.slope = kOrder * (b[1] - b[0]);
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(left); ++i) {
      b[i] += inside * (b[i + 1] - b[i]);
    }
  }
  curve.value = b[0] + (s - inside) * curve.slope;
  if (s != inside) {
    curve.bend = 0.0;
  }
  return curve;
}

}  // namespace plumbline::monopod
