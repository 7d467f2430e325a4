#include "validation/predict/flight_start.h"

#include <limits>
#include <stdexcept>

#include "validation/predict/estimate.h"

namespace plumbline::validation {

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
  Eigen::VectorXd x0 = predictor.initial_state(window);
  if (!trial.switches.empty() || !trial.start.empty()) {
    return x0;
  }
  Window flight = window;
  flight.count = samples_in_flight(predictor, window.first, window.first + window.count);
  if (flight.count < kFewest || flight.count == window.count) {
    return x0;
  }
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd x = x0;
  for (int i = 0; i < kSteps; ++i) {
    try {
      const Reduced at = reduce(predictor, flight, x, {}, {});
      const bool is_better = at.raw_sse < least;
      if (!is_better) {
        break;
      }
      const bool is_done = at.raw_sse > (1.0 - kDone) * least;
      least = at.raw_sse;
      x0 = x;
      if (is_done || !at.x_shift.allFinite()) {
        break;
      }
      x += at.x_shift;
    } catch (const std::runtime_error&) {
      break;  // a step too far: what is best so far
    }
  }
  return x0;
}

}  // namespace plumbline::validation
