#include "validation/identify/diagnose/correlation.h"

#include <cmath>
#include <vector>

namespace plumbline::validation {
namespace {

std::vector<Eigen::VectorXd> residuals(const Stage& stage, const Data& data) {
  std::vector<Eigen::VectorXd> all(data.windows.size());
  PredictorPool pool(stage.model, data);
  parallel_for(static_cast<int>(data.windows.size()), data.threads, [&](int w) {
    const auto i = static_cast<std::size_t>(w);
    pool.with(w, stage.parameters, stage.estimate.theta, [&](Predictor& predictor) {
      all[i] = predictor.residual(data.windows[i], stage.estimate.x0[i]);
    });
  });
  return all;
}

}  // namespace

double correlation(const Stage& before, const Stage& one, const Stage& other, const Data& data) {
  const std::vector<Eigen::VectorXd> r = residuals(before, data);
  const std::vector<Eigen::VectorXd> a = residuals(one, data);
  const std::vector<Eigen::VectorXd> b = residuals(other, data);
  double product = 0.0;
  double first = 0.0;
  double second = 0.0;
  for (std::size_t w = 0; w < r.size(); ++w) {
    product += (r[w] - a[w]).dot(r[w] - b[w]);
    first += (r[w] - a[w]).squaredNorm();
    second += (r[w] - b[w]).squaredNorm();
  }
  return first > 0.0 && second > 0.0 ? product / std::sqrt(first * second) : 0.0;
}

}  // namespace plumbline::validation
