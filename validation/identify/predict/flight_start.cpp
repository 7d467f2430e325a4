#include "validation/identify/predict/flight_start.h"

#include <Eigen/QR>
#include <limits>
#include <stdexcept>

namespace plumbline::validation {
namespace {

/// The state `given` with positions and velocities of a parabola through the measured positions of the
/// flight.
Eigen::VectorXd with_polynomial(const Predictor& predictor, const Window& flight, double period,
                                const Eigen::VectorXd& given) {
  const Eigen::MatrixXd positions =
      predictor.measured_positions().middleCols(flight.first, flight.count).transpose();
  Eigen::MatrixXd V(flight.count, 3);
  for (Eigen::Index k = 0; k < flight.count; ++k) {
    const double t = static_cast<double>(k) * period;
    V.row(k) << 1.0, t, t * t;
  }
  const Eigen::MatrixXd fitted = V.colPivHouseholderQr().solve(positions);
  Eigen::VectorXd x = given;
  x.head(positions.cols()) = fitted.row(0).transpose();
  x.segment(positions.cols(), positions.cols()) = fitted.row(1).transpose();
  return x;
}

}  // namespace

Eigen::Index samples_in_flight(Predictor& predictor, Eigen::Index first, Eigen::Index end) {
  model::Plant& plant = predictor.plant();
  if (!plant.meets_ground()) {
    return 0;
  }
  const Eigen::MatrixXd positions = predictor.measured_positions();
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  const int feet = static_cast<int>(plant.model().feet.size());
  Eigen::Index k = first;
  for (; k < end; ++k) {
    x.head(plant.positions()) = positions.col(k);
    for (int foot = 0; foot < feet; ++foot) {
      if (plant.foot_depth(foot, x.data()).depth > 0.0) {
        return k - first;
      }
    }
  }
  return k - first;
}

Eigen::VectorXd state_at_start(Predictor& predictor, const Trial& trial, const Window& window) {
  constexpr Eigen::Index kFewest = 5;  // samples: two for each position and velocity, and some to spare
  constexpr int kSteps = 6;
  constexpr double kDone = 1e-6;  // of the squared residuals
  const Eigen::VectorXd given = predictor.initial_state(window);
  if (!trial.switches.empty() || !trial.start.empty()) {
    return given;
  }
  Window flight = window;
  flight.count = samples_in_flight(predictor, window.first, window.first + window.count);
  if (flight.count < kFewest || flight.count == window.count) {
    return given;
  }
  Eigen::VectorXd x = with_polynomial(predictor, flight, trial.period, given);
  Eigen::VectorXd best = given;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    try {
      const Linearisation at = predictor.linearise(flight, x, {});
      const double square = at.r.squaredNorm();
      if (!(square < least)) {
        break;
      }
      const bool is_done = square > (1.0 - kDone) * least;
      least = square;
      best = x;
      if (is_done) {
        break;
      }
      // What no sensor sees stays: a basic solution has zeros there.
      const Eigen::Index moving = 2 * predictor.plant().positions();
      x.head(moving) += at.Jx.leftCols(moving).colPivHouseholderQr().solve(at.r);
    } catch (const std::runtime_error&) {
      break;  // a step too far: what is best so far
    }
  }
  return best;
}

}  // namespace plumbline::validation
