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

/// How far outside 0..1 a curve is still bent.
constexpr double kFade = 0.1;

/// Within 0..1 the polynomial. Outside its curvature fades to nothing over kFade and it goes on in a straight
/// line: an event that comes late then meets no jump of the torques, and one that does not come no polynomial
/// that runs away.
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
  curve.value = b[0];
  if (s != inside) {
    const double way = s > inside ? 1.0 : -1.0, beyond = way * (s - inside);
    const double d = beyond < kFade ? beyond : kFade;
    const double turn = way * curve.bend * (d - d * d / (2.0 * kFade));
    curve.value += (s - inside) * curve.slope + curve.bend * (d * d / 2.0 - d * d * d / (6.0 * kFade)) +
                   way * turn * (beyond - d);
    curve.slope += turn;
    curve.bend *= 1.0 - d / kFade;
  }
  return curve;
}

}  // namespace plumbline::monopod
