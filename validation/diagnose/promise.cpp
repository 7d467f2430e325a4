#include "validation/diagnose/promise.h"

#include <algorithm>

#include "validation/predict/box_least_squares.h"

namespace plumbline::validation {

Sum sum_of(const std::vector<Reduced>& reduced, const std::vector<int>& windows, const Data& data,
           Role role) {
  Sum sum;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const auto w = static_cast<std::size_t>(windows[i]);
    if (data.role(w) != role) {
      continue;
    }
    if (sum.H.size() == 0) {
      sum.H = Eigen::MatrixXd::Zero(reduced[i].H.rows(), reduced[i].H.cols());
      sum.g = Eigen::VectorXd::Zero(reduced[i].g.size());
    }
    sum.H += reduced[i].H;
    sum.g += reduced[i].g;
    sum.sse += reduced[i].sse;
    const Trial& trial = data.trials[static_cast<std::size_t>(data.windows[w].trial)];
    sum.samples += static_cast<double>(data.windows[w].count) * static_cast<double>(trial.measured.size());
  }
  return sum;
}

double promised_square(const Sum& sum, const std::vector<Eigen::Index>& chosen, const Eigen::VectorXd& d) {
  if (sum.samples == 0.0) {
    return 0.0;
  }
  double cost = sum.sse;
  for (std::size_t a = 0; a < chosen.size(); ++a) {
    cost -= 2.0 * sum.g[chosen[a]] * d[static_cast<Eigen::Index>(a)];
    for (std::size_t b = 0; b < chosen.size(); ++b) {
      cost += d[static_cast<Eigen::Index>(a)] * sum.H(chosen[a], chosen[b]) * d[static_cast<Eigen::Index>(b)];
    }
  }
  // The floor is what the sensors leave: a linearised promise below it is no better than the floor.
  return std::max(cost / sum.samples, 0.9);
}

Eigen::VectorXd solve_chosen(const Sum& train, const std::vector<Eigen::Index>& chosen, const Prior& known,
                             const Room& bounds) {
  const auto n = static_cast<Eigen::Index>(chosen.size());
  Eigen::MatrixXd H(n, n);
  Eigen::VectorXd g(n);
  Eigen::VectorXd lower(n);
  Eigen::VectorXd upper(n);
  for (Eigen::Index a = 0; a < n; ++a) {
    const Eigen::Index i = chosen[static_cast<std::size_t>(a)];
    g[a] = train.g[i] + known.g[i];
    lower[a] = bounds.lower[i];
    upper[a] = bounds.upper[i];
    for (Eigen::Index b = 0; b < n; ++b) {
      H(a, b) = train.H(i, chosen[static_cast<std::size_t>(b)]);
    }
    H(a, a) += known.H[i];
  }
  return box_least_squares(H, g, lower, upper);
}

}  // namespace plumbline::validation
