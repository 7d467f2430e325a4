#include "validation/report/traces.h"

#include <limits>

namespace plumbline::validation {

std::vector<Eigen::MatrixXd> predicted_traces(const Stage& stage, const Data& data,
                                              const Progress& progress) {
  std::vector<Eigen::MatrixXd> traces;
  for (const Trial& trial : data.trials) {
    traces.push_back(Eigen::MatrixXd::Constant(trial.samples(),
                                               static_cast<Eigen::Index>(trial.measured.size()),
                                               std::numeric_limits<double>::quiet_NaN()));
  }
  progress("drawing the predictions", 0.0);
  PredictorPool pool(stage.model, data);
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    const Window& window = data.windows[i];
    pool.with(w, stage.parameters, stage.estimate.theta, [&](Predictor& predictor) {
      traces[static_cast<std::size_t>(window.trial)].middleRows(window.first, window.count) =
          predictor.predict(window, stage.estimate.x0[i]);
    });
  });
  return traces;
}

std::vector<Span> spans_of(const Data& data, std::size_t trial) {
  std::vector<Span> spans;
  for (const Window& window : data.windows) {
    if (window.trial == static_cast<int>(trial)) {
      spans.push_back({window.first, window.count});
    }
  }
  return spans;
}

}  // namespace plumbline::validation
