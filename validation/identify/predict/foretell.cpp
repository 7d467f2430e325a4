#include "validation/identify/predict/foretell.h"

#include <algorithm>
#include <cmath>

#include "validation/identify/predict/box_least_squares.h"

namespace plumbline::validation {
namespace {

double prior_cost(const Prior& known, const Eigen::VectorXd& d) {
  return -2.0 * known.g.dot(d) + d.dot(known.H * d);
}

/// Room within the bounds as far as a linearisation is trusted.
Room trusted_room(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                  const Eigen::VectorXd& units) {
  constexpr double kTrusted = 0.5;
  Room bounds = room(parameters, theta, units);
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    if (!std::isfinite(parameters[p].deviation)) {
      bounds.lower[i] = std::max(bounds.lower[i], -kTrusted);
      bounds.upper[i] = std::min(bounds.upper[i], kTrusted);
    }
  }
  return bounds;
}

/// The train windows' equations without the slope that the fit has left: it has ended here, and a step that
/// it did not take is not counted on. A slope that presses a value against its bound stays.
Sum at_rest(Sum train, const Prior& known, const Room& bounds) {
  for (Eigen::Index p = 0; p < train.g.size(); ++p) {
    const double slope = train.g[p] + known.g[p];
    const bool pressed = slope > 0.0 ? bounds.upper[p] <= 0.0 : bounds.lower[p] >= 0.0;
    train.g[p] -= pressed ? 0.0 : slope;
  }
  return train;
}

}  // namespace

Sum sum_of(const std::vector<Reduced>& reduced, const std::vector<int>& windows, const Data& data,
           Role role) {
  const Eigen::Index n = reduced.empty() ? 0 : reduced.front().g.size();
  Sum sum{Eigen::MatrixXd::Zero(n, n), Eigen::VectorXd::Zero(n)};
  for (std::size_t i = 0; i < windows.size(); ++i) {
    const auto w = static_cast<std::size_t>(windows[i]);
    if (data.role(w) != role) {
      continue;
    }
    sum.H += reduced[i].H;
    sum.g += reduced[i].g;
    sum.sse += reduced[i].sse;
    sum.samples += readings(data, windows[i]);
  }
  return sum;
}

Foretold foretell(const Sum& train, const Sum& held_out, const Prior& known, const Room& bounds) {
  Eigen::MatrixXd H = train.H;
  H += known.H;
  const Eigen::VectorXd g = train.g + known.g;
  Foretold result;
  result.train_step = box_least_squares(H, g, bounds.lower, bounds.upper);
  result.step = box_least_squares(H + held_out.H, g + held_out.g, bounds.lower, bounds.upper);
  result.train = train.cost(result.train_step);
  const double regret = train.cost(result.step) + prior_cost(known, result.step) - result.train -
                        prior_cost(known, result.train_step);
  result.held_out = held_out.cost(result.step) + std::max(regret, 0.0);
  return result;
}

Eigen::VectorXd stepped(const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                        const Eigen::VectorXd& units, const Eigen::VectorXd& step) {
  Eigen::VectorXd to = theta;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const auto i = static_cast<Eigen::Index>(p);
    const double search = to_search(parameters[p].scale, theta[i]) + units[i] * step[i];
    const double value = from_search(parameters[p].scale, search);
    to[i] = std::isfinite(value) ? std::clamp(value, parameters[p].lower, parameters[p].upper) : theta[i];
  }
  return to;
}

Prediction prediction(const Data& data, const std::vector<Reduced>& reduced,
                      const std::vector<FreeParameter>& parameters, const Eigen::VectorXd& theta,
                      const Eigen::VectorXd& units) {
  Prediction result{theta, {}, {}};
  for (const Reduced& one : reduced) {
    result.square.push_back(one.square);
  }
  if (!parameters.empty() && data.has(Role::held_out)) {
    const std::vector<int> windows = data.all_windows();
    const Sum held_out = sum_of(reduced, windows, data, Role::held_out);
    const Prior known = prior(parameters, units, theta);
    const Room bounds = trusted_room(parameters, theta, units);
    const Sum train = at_rest(sum_of(reduced, windows, data, Role::train), known, bounds);
    const Foretold foretold = foretell(train, held_out, known, bounds);
    result.theta = stepped(parameters, theta, units, foretold.step);
    // The cost of the train windows' and the prior's consent is shared out over the held-out windows.
    const double share = foretold.held_out / std::max(held_out.cost(foretold.step), 1e-300);
    for (std::size_t w = 0; w < reduced.size(); ++w) {
      if (data.role(w) == Role::held_out && reduced[w].sse > 0.0) {
        const Sum one{reduced[w].H, reduced[w].g, reduced[w].sse};
        result.square[w] *= share * std::max(one.cost(foretold.step), 0.0) / reduced[w].sse;
      }
    }
  }
  result.scores = score(data, result.square);
  return result;
}

}  // namespace plumbline::validation
