#include "validation/identify/compare/horizon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "simulator/model/kinds.h"

namespace plumbline::validation {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// Squared errors of one window's channels at one horizon; empty where it does not reach so far.
struct Reached {
  Eigen::VectorXd square;
  bool lost = false;
};

/// The unit in which people speak of a channel, and how many of it are one SI unit.
struct TaskUnit {
  std::string name;
  double factor = 1.0;
};

TaskUnit task_unit(const std::string& unit) {
  if (unit == "rad") {
    return {"deg", 180.0 / kPi};
  }
  return unit == "m" ? TaskUnit{"mm", 1000.0} : TaskUnit{unit, 1.0};
}

Eigen::Index steps_of(const Trial& trial, double horizon) {
  return static_cast<Eigen::Index>(std::lround(horizon / trial.period));
}

/// Does something strike the robot between two samples?
bool is_struck(const Trial& trial, Eigen::Index from, Eigen::Index to) {
  return std::any_of(trial.events.begin(), trial.events.end(),
                     [&](double event) { return event > trial.time[from] && event <= trial.time[to]; });
}

/// Does the recording hang together from one sample to the other?
bool is_in_one_stretch(const Trial& trial, Eigen::Index from, Eigen::Index to) {
  const std::vector<Stretch> stretches = stretches_of(trial);
  return std::any_of(stretches.begin(), stretches.end(),
                     [&](const Stretch& one) { return one.first <= from && to < one.end; });
}

/// How many samples behind the window may be predicted: those of the longest horizon that counts.
Eigen::Index reach_of(const Trial& trial, const Window& window, const std::vector<double>& horizons) {
  const Eigen::Index last = window.first + window.count - 1;
  Eigen::Index reach = 0;
  for (const double horizon : horizons) {
    const Eigen::Index steps = steps_of(trial, horizon);
    if (is_in_one_stretch(trial, last, last + steps) && !is_struck(trial, last, last + steps)) {
      reach = std::max(reach, steps);
    }
  }
  return reach;
}

Eigen::VectorXd squares_at(const Trial& trial, Eigen::Index sample, const Eigen::RowVectorXd& predicted) {
  Eigen::VectorXd square(predicted.size());
  for (Eigen::Index c = 0; c < predicted.size(); ++c) {
    const double error = trial.measured[static_cast<std::size_t>(c)].values[sample] - predicted[c];
    square[c] = error * error;
  }
  return square;
}

/// Goes on behind one window; by horizon.
std::vector<Reached> go_on(Predictor& predictor, const Trial& trial, const Window& window,
                           const Eigen::VectorXd& x0, const std::vector<double>& horizons) {
  std::vector<Reached> reached(horizons.size());
  Window longer = window;
  longer.events.clear();
  const Eigen::Index reach = reach_of(trial, window, horizons);
  if (reach == 0) {
    return reached;
  }
  longer.count = window.count + reach;
  Eigen::MatrixXd predicted;
  try {
    predicted = predictor.predict(longer, x0);
  } catch (const std::runtime_error&) {  // the model runs away: it reaches none of them
  }
  for (std::size_t h = 0; h < horizons.size(); ++h) {
    const Eigen::Index row = window.count - 1 + steps_of(trial, horizons[h]);
    if (row >= longer.count) {
      continue;
    }
    if (predicted.rows() <= row || !predicted.row(row).allFinite()) {
      reached[h].lost = true;
    } else {
      reached[h].square = squares_at(trial, window.first + row, predicted.row(row));
    }
  }
  return reached;
}

/// All windows of one trial at one horizon, one entry for each channel.
std::vector<HorizonError> sum_up(const model::Model& model, const Trial& trial, double horizon,
                                 const std::vector<const Reached*>& windows) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(trial.measured.size()));
  int count = 0;
  int lost = 0;
  for (const Reached* one : windows) {
    lost += one->lost ? 1 : 0;
    if (one->square.size() > 0) {
      sum += one->square;
      ++count;
    }
  }
  std::vector<HorizonError> errors;
  for (std::size_t c = 0; c < trial.measured.size() && count + lost > 0; ++c) {
    const std::string& channel = trial.measured[c].sensor;
    const TaskUnit unit = task_unit(model::reading_unit(model, channel));
    const double rms = count > 0 ? std::sqrt(sum[static_cast<Eigen::Index>(c)] / count) * unit.factor
                                 : std::numeric_limits<double>::infinity();
    errors.push_back({trial.name, channel, unit.name, trial.role, horizon, rms, count, lost});
  }
  return errors;
}

}  // namespace

const std::vector<double>& usual_horizons() {
  static const std::vector<double> kHorizons{0.05, 0.1, 0.5, 2.0};
  return kHorizons;
}

std::vector<HorizonError> horizon_errors(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                         const Estimate& estimate, const std::vector<double>& horizons) {
  const Data& data = pool.data();
  std::vector<std::vector<Reached>> reached(data.windows.size());
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto at = static_cast<std::size_t>(w);
    if (data.stop != nullptr && data.stop->raised) {
      throw Stopped();
    }
    const Trial& trial = data.trials[static_cast<std::size_t>(data.windows[at].trial)];
    pool.with(w, parameters, estimate.theta, [&](Predictor& predictor) {
      reached[at] = go_on(predictor, trial, data.windows[at], estimate.x0[at], horizons);
    });
  });
  std::vector<HorizonError> errors;
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    for (std::size_t h = 0; h < horizons.size(); ++h) {
      std::vector<const Reached*> windows;
      for (std::size_t w = 0; w < data.windows.size(); ++w) {
        if (data.windows[w].trial == static_cast<int>(t)) {
          windows.push_back(&reached[w][h]);
        }
      }
      for (HorizonError& error : sum_up(pool.model(), data.trials[t], horizons[h], windows)) {
        errors.push_back(std::move(error));
      }
    }
  }
  return errors;
}

}  // namespace plumbline::validation
