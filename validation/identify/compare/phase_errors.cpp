#include "validation/identify/compare/phase_errors.h"

#include <cmath>
#include <limits>

#include "simulator/model/kinds.h"

namespace plumbline::validation {
namespace {

void add_phases(const Trial& trial, const model::Sensor& sensor, const std::string& unit,
                const Measured& channel, const Eigen::VectorXd& residual, std::vector<PhaseError>& errors) {
  const PhaseTable table = phases_of(trial, channel);
  for (std::size_t p = 0; p < table.phases.size(); ++p) {
    double sum = 0.0;
    double square = 0.0;
    double count = 0.0;
    for (const Eigen::Index k : table.members[p]) {
      if (std::isfinite(residual[k])) {
        sum += residual[k];
        square += residual[k] * residual[k];
        count += 1.0;
      }
    }
    if (count > 0.0) {
      const double rms = std::sqrt(square / count);
      errors.push_back({trial.name, sensor.name, unit, table.phases[p],
                        count / static_cast<double>(trial.samples()), rms, sum / count,
                        rms / sensor.floor()});
    }
  }
}

}  // namespace

std::vector<Eigen::MatrixXd> predicted_traces(PredictorPool& pool,
                                              const std::vector<FreeParameter>& parameters,
                                              const Estimate& estimate) {
  const Data& data = pool.data();
  std::vector<Eigen::MatrixXd> traces;
  for (const Trial& trial : data.trials) {
    traces.push_back(Eigen::MatrixXd::Constant(trial.samples(),
                                               static_cast<Eigen::Index>(trial.measured.size()),
                                               std::numeric_limits<double>::quiet_NaN()));
  }
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    const Window& window = data.windows[i];
    pool.with(w, parameters, estimate.theta, [&](Predictor& predictor) {
      traces[static_cast<std::size_t>(window.trial)].middleRows(window.first, window.count) =
          predictor.predict(window, estimate.x0[i]);
    });
  });
  return traces;
}

std::vector<PhaseError> phase_errors(PredictorPool& pool, const std::vector<FreeParameter>& parameters,
                                     const Estimate& estimate) {
  const std::vector<Eigen::MatrixXd> predicted = predicted_traces(pool, parameters, estimate);
  const std::vector<Trial>& trials = pool.data().trials;
  std::vector<PhaseError> errors;
  for (std::size_t t = 0; t < trials.size(); ++t) {
    for (std::size_t c = 0; c < trials[t].measured.size(); ++c) {
      const Measured& channel = trials[t].measured[c];
      add_phases(trials[t], sensor_of(pool.model(), channel),
                 model::reading_unit(pool.model(), channel.sensor), channel,
                 channel.values - predicted[t].col(static_cast<Eigen::Index>(c)), errors);
    }
  }
  return errors;
}

}  // namespace plumbline::validation
