#include "validation/identify/compare/defects.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "simulator/model/positions_from.h"
#include "validation/identify/predict/estimate.h"
#include "validation/identify/predict/lost_windows.h"

namespace plumbline::validation {
namespace {

constexpr double kShare = 0.125;  // of a window
constexpr double kEvent = 4.0;    // deviations

/// A linear function of the state: position or speed of a place.
struct Reading {
  std::string at, unit;
  bool is_speed = false;
  Eigen::VectorXd row;
};

/// Positions and speeds of coordinates, and of motors that do not move as one of them.
std::vector<Reading> readings_of(const model::Model& model, const Trial& trial) {
  model::Plant plant(model, trial.locks, trial.terrain);
  const Eigen::Index n = plant.positions();
  std::vector<Reading> readings;
  std::vector<Eigen::VectorXd> known;
  const auto add = [&](const std::string& at, bool angular) {
    const Eigen::VectorXd direction = model::observe_place(plant, at, 1.0).row.transpose();
    const auto is_same = [&](const Eigen::VectorXd& other) {
      return std::abs(other.dot(direction)) > (1.0 - 1e-9) * other.norm() * direction.norm();
    };
    if (direction.norm() == 0.0 || std::any_of(known.begin(), known.end(), is_same)) {
      return;
    }
    known.push_back(direction);
    for (const bool is_speed : {true, false}) {
      Reading reading{at, angular ? "rad" : "m", is_speed, Eigen::VectorXd::Zero(plant.states())};
      reading.unit += is_speed ? "/s" : "";
      reading.row.segment(is_speed ? n : 0, n) = direction;
      readings.push_back(reading);
    }
  };
  for (const model::Coordinate& coordinate : model.coordinates) {
    add(coordinate.name, coordinate.angular);
  }
  for (const model::Motor& motor : model.motors) {
    add(motor.name, motor.angular);
  }
  return readings;
}

/// H^-1 = L L'. Of what no residual shows the spread is large, not infinite.
Eigen::MatrixXd root_of_inverse(Eigen::MatrixXd H) {
  constexpr double kUnseen = 1e-12;
  const Eigen::VectorXd scale = H.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  H = scale.asDiagonal() * H * scale.asDiagonal();
  H.diagonal().array() += kUnseen;
  const Eigen::MatrixXd lower = H.llt().matrixL();
  const Eigen::MatrixXd inverse =
      lower.triangularView<Eigen::Lower>().solve(Eigen::MatrixXd::Identity(H.rows(), H.cols()));
  return scale.asDiagonal() * inverse.transpose();
}

/// Two segments in a row.
struct Joint {
  Window before;  ///< up to the first sample of the next
  const Eigen::VectorXd& start;
  const Eigen::VectorXd& next;
  Eigen::MatrixXd spread, next_spread;  ///< roots of the starts' covariances, for errors of one floor
};

/// State at the end of the segment before, and the root of its covariance.
struct End {
  Eigen::VectorXd x;
  Eigen::MatrixXd root;
};

End end_of(Predictor& predictor, const Joint& joint) {
  constexpr double kStep = 0.1;  // of a deviation: small against what is curved
  const auto run = [&](const Eigen::VectorXd& x0) {
    predictor.predict(joint.before, x0);
    const Eigen::MatrixXd states = predictor.predicted_states();
    return Eigen::VectorXd(states.col(states.cols() - 1));
  };
  End end{run(joint.start), joint.spread};
  for (Eigen::Index k = 0; k < joint.spread.cols(); ++k) {
    end.root.col(k) = (run(joint.start + kStep * joint.spread.col(k)) - end.x) / kStep;
  }
  return end;
}

/// The reading that jumps by most deviations, if that is an event.
std::optional<Defect> worst_of(Predictor& predictor, const Joint& joint, const std::vector<Reading>& readings,
                               double error) {
  const End end = end_of(predictor, joint);
  const Eigen::VectorXd jump = joint.next - end.x;
  Defect worst;
  for (const Reading& one : readings) {
    const double spread = error * std::hypot((one.row.transpose() * end.root).norm(),
                                             (one.row.transpose() * joint.next_spread).norm());
    const double value = one.row.dot(jump);
    if (spread > 0.0 && std::abs(value) / spread > worst.deviations) {
      worst.deviations = std::abs(value) / spread;
      worst.at = one.at;
      worst.unit = one.unit;
      worst.is_speed = one.is_speed;
      worst.jump = value;
    }
  }
  if (!(worst.deviations > kEvent)) {
    return {};
  }
  if (worst.is_speed) {
    worst.impulse = worst.jump * predictor.plant().inertia_of(worst.at);
  }
  return worst;
}

std::vector<Defect> defects_between(const Data& segments, PredictorPool& pool) {
  const Estimate estimate = estimate_states(pool);
  const double error = std::max(1.0, estimate.scores.train);
  const std::vector<Reduced> reduced = reduce(pool, segments.all_windows(), {}, {}, estimate.x0, {});
  std::vector<std::vector<Reading>> readings;
  for (const Trial& trial : segments.trials) {
    readings.push_back(readings_of(pool.model(), trial));
  }
  const auto count = static_cast<int>(segments.windows.size());
  std::vector<std::optional<Defect>> found(segments.windows.size());
  parallel_for(count - 1, segments.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    const Window& one = segments.windows[i];
    const Window& next = segments.windows[i + 1];
    const Trial& trial = segments.trials[static_cast<std::size_t>(one.trial)];
    const bool adjoins = next.trial == one.trial && next.first >= one.first + one.count - 1 &&
                         next.first <= one.first + one.count;
    if (!adjoins || estimate.x0[i].size() != estimate.x0[i + 1].size() ||
        !std::isfinite(estimate.square[i].sum()) || !std::isfinite(estimate.square[i + 1].sum())) {
      return;
    }
    Joint joint{one, estimate.x0[i], estimate.x0[i + 1], root_of_inverse(reduced[i].x_H),
                root_of_inverse(reduced[i + 1].x_H)};
    joint.before.count = next.first - one.first + 1;
    pool.with(w, {}, {}, [&](Predictor& predictor) {
      try {
        found[i] = worst_of(predictor, joint, readings[static_cast<std::size_t>(one.trial)], error);
      } catch (const Stopped&) {
        throw;
      } catch (const std::runtime_error&) {
        return;  // a deviation of the start cannot be integrated: nothing is said of this instant
      }
    });
    if (found[i]) {
      found[i]->trial = trial.name;
      found[i]->role = trial.role;
      found[i]->time = trial.time[next.first];
    }
  });
  std::vector<Defect> all;
  for (const std::optional<Defect>& one : found) {
    if (one) {
      all.push_back(*one);
    }
  }
  return all;
}

}  // namespace

std::vector<Defect> defects(const model::Model& model, const Data& data) {
  if (data.trials.empty()) {
    return {};
  }
  std::vector<LostWindow> lost;
  const Data kept = without_lost(model, data, lost);
  const Data segments = kept.segments(kShare * data.predict.window);
  std::vector<Defect> all;
  try {
    PredictorPool pool(model, segments);
    all = defects_between(segments, pool);
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return {};  // some segment cannot be integrated at all
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Defect& a, const Defect& b) { return a.deviations > b.deviations; });
  return all;
}

}  // namespace plumbline::validation
