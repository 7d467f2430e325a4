#include "validation/report/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace plumbline::validation {
namespace {

constexpr double kTurn = 6.283185307179586;

Eigen::VectorXd hann(Eigen::Index n) {
  Eigen::VectorXd w(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    w[k] = 0.5 - 0.5 * std::cos(kTurn * (static_cast<double>(k) + 0.5) / static_cast<double>(n));
  }
  return w;
}

Eigen::Index common_length(const std::vector<Span>& spans) {
  Eigen::Index longest = 0;
  for (const Span& span : spans) {
    longest = std::max(longest, span.count);
  }
  Eigen::Index length = longest;
  for (const Span& span : spans) {
    if (2 * span.count >= longest) {
      length = std::min(length, span.count);
    }
  }
  return length;
}

}  // namespace

Spectrum spectrum(const Eigen::VectorXd& residual, const std::vector<Span>& spans, double period) {
  const Eigen::Index n = common_length(spans);
  const Eigen::VectorXd w = hann(n);
  const Eigen::Index bins = n / 2 + 1;
  Eigen::VectorXd power = Eigen::VectorXd::Zero(bins);
  Eigen::FFT<double> transform;
  int used = 0;
  for (const Span& span : spans) {
    if (span.count < n) {
      continue;
    }
    const Eigen::VectorXd shaped = residual.segment(span.first, n).cwiseProduct(w);
    Eigen::VectorXcd lines;
    transform.fwd(lines, shaped);
    power += lines.head(bins).cwiseAbs2();
    ++used;
  }
  power *= 2.0 * period / (w.squaredNorm() * std::max(1, used));
  return {1.0 / (static_cast<double>(n) * period), power.cwiseSqrt()};
}

double density_of_floor(double floor, double period) { return floor * std::sqrt(2.0 * period); }

}  // namespace plumbline::validation
