#include "validation/identify/diagnose/work.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace plumbline::validation {

double work_of(const model::Model& model, const Data& data) {
  constexpr int kWindows = 6;
  const auto all = static_cast<int>(data.windows.size());
  const int step = std::max(1, all / kWindows);
  double samples = 0.0;
  for (int w = 0; w < all; w += step) {
    samples += static_cast<double>(data.windows[static_cast<std::size_t>(w)].count);
  }
  PredictorPool pool(model, data);
  try {
    parallel_for((all + step - 1) / step, data.threads, [&](int i) {
      const int w = i * step;
      pool.with(w, {}, {}, [&](Predictor& predictor) {
        const Window& window = data.windows[static_cast<std::size_t>(w)];
        predictor.residual(window, predictor.initial_state(window));
      });
    });
  } catch (const Stopped&) {
    throw;
  } catch (const std::runtime_error&) {
    return std::numeric_limits<double>::infinity();
  }
  return static_cast<double>(pool.evaluations()) / std::max(samples, 1.0);
}

}  // namespace plumbline::validation
