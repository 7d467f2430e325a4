#include "simulator/sensing/differentiation.h"

#include <Eigen/QR>
#include <cmath>
#include <stdexcept>
#include <string>

namespace plumbline::sensing {
namespace {

/// Derivative at sample `at` of the least-squares polynomial over samples 0 .. window-1, as weights.
/// The abscissa is scaled to [-1, 1], which keeps the powers well conditioned at every window length.
Eigen::VectorXd weights_at(int order, int window, int at) {
  const double half = 0.5 * (window - 1);
  const double x_at = (at - half) / half;
  Eigen::MatrixXd powers(window, order + 1);
  for (int k = 0; k < window; ++k) {
    double power = 1.0;
    for (int j = 0; j <= order; ++j) {
      powers(k, j) = power;
      power *= (k - half) / half;
    }
  }
  Eigen::VectorXd slope = Eigen::VectorXd::Zero(order + 1);  // d(x^j)/d(sample) at x_at
  double power = 1.0;
  for (int j = 1; j <= order; ++j) {
    slope[j] = j * power / half;
    power *= x_at;
  }
  // Coefficients are R^-1 Q' y, so the weights are Q R^-T slope.
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(powers);
  const Eigen::MatrixXd R = qr.matrixQR().topRows(order + 1);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(window);
  z.head(order + 1) = R.triangularView<Eigen::Upper>().transpose().solve(slope);
  return qr.householderQ() * z;
}

int sample_in_window(const DifferentiationOptions& options) {
  return options.evaluation == Evaluation::end ? options.window - 1 : options.window / 2;
}

void check_period(double period) {
  if (!(std::isfinite(period) && period > 0.0)) {
    throw std::invalid_argument("sample period: found " + std::to_string(period) +
                                ", expected a positive number of seconds");
  }
}

}  // namespace

DifferentiationOptions DifferentiationOptions::causal() { return {Evaluation::end, 2, 9}; }

DifferentiationOptions DifferentiationOptions::acausal() { return {Evaluation::centre, 4, 13}; }

void DifferentiationOptions::validate() const {
  if (order < 1) {
    throw std::invalid_argument("differentiation order: found " + std::to_string(order) +
                                ", expected 1 or more");
  }
  if (window <= order) {
    throw std::invalid_argument("differentiation window: found " + std::to_string(window) +
                                " samples, expected more than the order " + std::to_string(order));
  }
  if (evaluation == Evaluation::centre && window % 2 == 0) {
    throw std::invalid_argument("differentiation window: found " + std::to_string(window) +
                                " samples, expected an odd number, which has a sample in the centre");
  }
}

Eigen::VectorXd velocity_weights(const DifferentiationOptions& options) {
  options.validate();
  return weights_at(options.order, options.window, sample_in_window(options));
}

double noise_gain(const DifferentiationOptions& options, double period) {
  check_period(period);
  return velocity_weights(options).norm() / period;
}

Eigen::VectorXd differentiate(const Eigen::VectorXd& positions, double period,
                              const DifferentiationOptions& options) {
  check_period(period);
  const Eigen::VectorXd inner = velocity_weights(options);
  const Eigen::Index n = positions.size();
  const Eigen::Index window = options.window;
  if (n < window) {
    throw std::invalid_argument("differentiation: found " + std::to_string(n) +
                                " samples, expected at least the window's " + std::to_string(window));
  }
  const Eigen::Index before = sample_in_window(options);
  const Eigen::Index last_first = n - window;  // first sample of the last whole window
  Eigen::VectorXd velocity(n);
  for (Eigen::Index first = 0; first <= last_first; ++first) {
    velocity[first + before] = inner.dot(positions.segment(first, window));
  }
  for (int at = 0; at < options.window; ++at) {
    if (at < before) {
      velocity[at] = weights_at(options.order, options.window, at).dot(positions.head(window));
    } else if (at > before) {
      velocity[last_first + at] = weights_at(options.order, options.window, at).dot(positions.tail(window));
    }
  }
  return velocity / period;
}

RunningDifferentiator::RunningDifferentiator(const DifferentiationOptions& options, double period)
    : weights_(velocity_weights(options)), window_(Eigen::VectorXd::Zero(options.window)) {
  check_period(period);
  if (options.evaluation != Evaluation::end) {
    throw std::invalid_argument(
        "running differentiation: found evaluation at the centre, expected at the "
        "end: the samples after the centre are not known yet");
  }
  weights_ /= period;
}

double RunningDifferentiator::update(double position) {
  if (!started_) {
    window_.setConstant(position);
    started_ = true;
  }
  window_[oldest_] = position;
  const Eigen::Index size = window_.size();
  oldest_ = (oldest_ + 1) % size;
  // The ring in order of age is its part behind `oldest_` and then its part before.
  const Eigen::Index tail = size - oldest_;
  return weights_.head(tail).dot(window_.tail(tail)) + weights_.tail(oldest_).dot(window_.head(oldest_));
}

void RunningDifferentiator::reset() {
  oldest_ = 0;
  started_ = false;
}

}  // namespace plumbline::sensing
