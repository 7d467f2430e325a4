#include "validation/report/traces.h"

#include <algorithm>

#include "validation/identify/compare/phase_errors.h"

namespace plumbline::validation {

std::vector<Eigen::MatrixXd> predicted_traces(const Stage& stage, const Data& data,
                                              const Progress& progress) {
  progress("drawing the predictions", 0.0);
  PredictorPool pool(stage.model, data);
  return predicted_traces(pool, stage.parameters, stage.estimate);
}

std::vector<std::size_t> windows_in_time(const Data& data, std::size_t trial) {
  std::vector<std::size_t> order;
  for (std::size_t w = 0; w < data.windows.size(); ++w) {
    if (data.windows[w].trial == static_cast<int>(trial)) {
      order.push_back(w);
    }
  }
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return data.windows[a].first < data.windows[b].first; });
  return order;
}

std::vector<Span> spans_of(const Data& data, std::size_t trial) {
  std::vector<Span> spans;
  for (const std::size_t w : windows_in_time(data, trial)) {
    spans.push_back({data.windows[w].first, data.windows[w].count});
  }
  return spans;
}

}  // namespace plumbline::validation
