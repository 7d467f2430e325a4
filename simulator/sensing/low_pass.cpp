#include "simulator/sensing/low_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace plumbline::sensing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr Eigen::Index kFewestSamples = 8;
constexpr double kEndPeriods =
    10.0;  // the filter has forgotten its start after so many periods of the cutoff

/// y = b0 x + s1, s1 = b1 x - a1 y + s2, s2 = b2 x - a2 y (transposed direct form).
struct Section {
  double b0, b1, b2, a1, a2;

  void run(Eigen::VectorXd& signal) const {
    // Begins as if the first sample had always been there.
    double s1 = (1.0 - b0) * signal[0];
    double s2 = (b2 - a2) * signal[0];
    for (Eigen::Index k = 0; k < signal.size(); ++k) {
      const double x = signal[k];
      const double y = b0 * x + s1;
      s1 = b1 * x - a1 * y + s2;
      s2 = b2 * x - a2 * y;
      signal[k] = y;
    }
  }
};

/// The two pole pairs of a fourth-order Butterworth filter, by the bilinear transformation
/// s = (1 - 1/z) / (1 + 1/z) / tan(pi cutoff T).
std::array<Section, 2> butterworth(double period, double cutoff) {
  const double w = std::tan(kPi * cutoff * period);
  std::array<Section, 2> sections{};
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const double damping = 2.0 * std::sin(kPi * (2.0 * static_cast<double>(i) + 1.0) / 8.0);
    const double scale = 1.0 + damping * w + w * w;
    const double gain = w * w / scale;
    sections[i] = {gain, 2.0 * gain, gain, 2.0 * (w * w - 1.0) / scale, (1.0 - damping * w + w * w) / scale};
  }
  return sections;
}

/// The record with `more` samples turned about each of its ends.
Eigen::VectorXd continued(const Eigen::VectorXd& signal, Eigen::Index more) {
  const Eigen::Index n = signal.size();
  Eigen::VectorXd longer(n + 2 * more);
  longer.segment(more, n) = signal;
  for (Eigen::Index k = 1; k <= more; ++k) {
    longer[more - k] = 2.0 * signal[0] - signal[k];
    longer[more + n - 1 + k] = 2.0 * signal[n - 1] - signal[n - 1 - k];
  }
  return longer;
}

}  // namespace

Eigen::VectorXd low_pass(const Eigen::VectorXd& signal, double period, double cutoff) {
  if (!(std::isfinite(period) && period > 0.0)) {
    throw std::invalid_argument("low_pass: the period must be positive");
  }
  if (!(cutoff > 0.0 && cutoff < 0.5 / period)) {
    throw std::invalid_argument("low_pass: the cutoff must be between 0 and half the sample rate");
  }
  if (signal.size() < kFewestSamples) {
    throw std::invalid_argument("low_pass: at least 8 samples are needed");
  }
  const auto wanted = static_cast<Eigen::Index>(std::ceil(kEndPeriods / (cutoff * period)));
  const Eigen::Index more = std::min(signal.size() - 1, wanted);
  Eigen::VectorXd filtered = continued(signal, more);
  for (int direction = 0; direction < 2; ++direction) {
    for (const Section& section : butterworth(period, cutoff)) {
      section.run(filtered);
    }
    filtered.reverseInPlace();
  }
  return filtered.segment(more, signal.size());
}

}  // namespace plumbline::sensing
