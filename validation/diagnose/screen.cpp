#include "validation/diagnose/screen.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "validation/predict/box_least_squares.h"

namespace plumbline::validation {
namespace {

/// A law that can be linearised at its null value: it brings no state and no coordinate.
bool has_tangent(const Candidate& candidate, const effects::Values& start) {
  return candidate.place != effects::Place::ratio && candidate.law->state_count() == 0 &&
         candidate.law->is_null(start.data());
}

struct Sum {
  Eigen::MatrixXd H;
  Eigen::VectorXd g;
  double sse = 0.0;
  double samples = 0.0;
};

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

/// Solves for the chosen columns on the train windows; the promise is judged on both roles.
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

/// Of a law's parameters those that, at the strength where the law matters as much as the driving force, move
/// the prediction by a noticeable share of the floor. The others are numerical noise, and left where they
/// are.
std::vector<Eigen::Index> noticeable(const Sum& train, const std::vector<Eigen::Index>& own) {
  constexpr double kShareOfFloor = 0.03;
  std::vector<Eigen::Index> chosen;
  for (const Eigen::Index i : own) {
    if (std::isfinite(train.H(i, i)) && train.H(i, i) > kShareOfFloor * kShareOfFloor * train.samples) {
      chosen.push_back(i);
    }
  }
  return chosen;
}

/// Windows for the costly starts: enough to tell, spread over the trials.
std::vector<int> thinned(const Data& data) {
  std::vector<int> chosen;
  const std::size_t stride = data.windows.size() > 16 ? 2 : 1;
  for (std::size_t w = 0; w < data.windows.size(); w += stride) {
    chosen.push_back(static_cast<int>(w));
  }
  return chosen;
}

std::vector<Hypothesis> screen_tangents(const Stage& stage, const std::vector<Candidate>& candidates,
                                        const std::vector<Hypothesis>& all, const Data& data) {
  // One model with every candidate in it at its null value: it predicts as the stage does, and one
  // linearisation serves them all.
  model::Model model = stage.model;
  std::vector<FreeParameter> parameters = stage.parameters;
  std::vector<std::vector<Eigen::Index>> own(all.size());
  for (std::size_t h = 0; h < all.size(); ++h) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(all[h].candidate)];
    model.effects.push_back(make_use(candidate, all[h].start));
    const bool angular = model.place_is_angular(candidate.place, candidate.at);
    for (FreeParameter& parameter : searched_parameters_of(
             candidate, model.effects.back(), static_cast<int>(model.effects.size()) - 1, angular)) {
      own[h].push_back(static_cast<Eigen::Index>(parameters.size()));
      parameters.push_back(std::move(parameter));
    }
  }
  const std::vector<int> windows = data.all_windows();
  Eigen::VectorXd theta = values_of(model, parameters);
  theta.head(stage.estimate.theta.size()) = stage.estimate.theta;
  const Eigen::VectorXd units = search_units(parameters, theta);
  PredictorPool pool(model, data);
  const std::vector<Reduced> reduced = reduce(pool, windows, parameters, theta, stage.estimate.x0, units);
  const Sum train = sum_of(reduced, windows, data, Role::train);
  const Sum held_out = sum_of(reduced, windows, data, Role::held_out);
  const Room bounds = room(parameters, theta, units);
  const Prior known = prior(parameters, units, theta);
  std::vector<Hypothesis> found;
  for (std::size_t h = 0; h < all.size(); ++h) {
    const std::vector<Eigen::Index> moving = noticeable(train, own[h]);
    if (moving.empty()) {
      continue;
    }
    std::vector<Eigen::Index> chosen;
    for (std::size_t p = 0; p < stage.parameters.size(); ++p) {
      chosen.push_back(static_cast<Eigen::Index>(p));
    }
    chosen.insert(chosen.end(), moving.begin(), moving.end());
    Hypothesis hypothesis = all[h];
    const Eigen::VectorXd step = solve_chosen(train, chosen, known, bounds);
    hypothesis.promised_train = promised_square(train, chosen, step);
    hypothesis.promised_held_out = promised_square(held_out, chosen, step);
    hypothesis.x0.resize(data.windows.size());
    for (std::size_t w = 0; w < windows.size(); ++w) {
      Eigen::VectorXd x = stage.estimate.x0[w] + reduced[w].x_shift;
      for (std::size_t a = 0; a < chosen.size(); ++a) {
        x -= reduced[w].x_slope.col(chosen[a]) * step[static_cast<Eigen::Index>(a)];
      }
      hypothesis.x0[w] = x;
    }
    hypothesis.step =
        Eigen::VectorXd::Zero(static_cast<Eigen::Index>(stage.parameters.size() + own[h].size()));
    for (std::size_t a = 0; a < chosen.size(); ++a) {
      const bool is_own = chosen[a] >= static_cast<Eigen::Index>(stage.parameters.size());
      const Eigen::Index first_own = own[h].front() - static_cast<Eigen::Index>(stage.parameters.size());
      hypothesis.step[is_own ? chosen[a] - first_own : chosen[a]] = step[static_cast<Eigen::Index>(a)];
    }
    found.push_back(std::move(hypothesis));
  }
  return found;
}

/// Squared error of the stage on some of the windows as a share of that on all: promises made on a part of
/// the windows are brought to all of them by it.
double share_of_error(const Stage& stage, const std::vector<int>& windows, const Data& data, Role role) {
  const auto mean = [&](const std::vector<int>& some) {
    double sum = 0.0;
    double samples = 0.0;
    for (const int w : some) {
      if (data.role(static_cast<std::size_t>(w)) == role) {
        const Eigen::VectorXd& square = stage.estimate.square[static_cast<std::size_t>(w)];
        sum += square.sum();
        samples += static_cast<double>(data.windows[static_cast<std::size_t>(w)].count * square.size());
      }
    }
    return samples > 0.0 ? sum / samples : 0.0;
  };
  const double all = mean(data.windows_of(role));
  const double part = mean(windows);
  return all > 0.0 && part > 0.0 ? part / all : 1.0;
}

/// The windows of the costly starts, and what share of the stage's error is theirs.
struct Part {
  std::vector<int> windows;
  double train_share, held_out_share;
};

void screen_start(const Stage& stage, const std::vector<Candidate>& candidates, Hypothesis& hypothesis,
                  const Data& data, const Part& part) {
  const Extended extended =
      extend(stage, candidates[static_cast<std::size_t>(hypothesis.candidate)], hypothesis.start);
  PredictorPool pool(extended.model, data);
  const Eigen::VectorXd units = search_units(extended.parameters, extended.theta);
  const std::vector<Eigen::VectorXd> measured(data.windows.size());
  const std::vector<Reduced> reduced =
      reduce(pool, part.windows, extended.parameters, extended.theta, measured, units);
  const Sum train = sum_of(reduced, part.windows, data, Role::train);
  const Sum held_out = sum_of(reduced, part.windows, data, Role::held_out);
  std::vector<Eigen::Index> chosen(extended.parameters.size());
  for (std::size_t p = 0; p < chosen.size(); ++p) {
    chosen[p] = static_cast<Eigen::Index>(p);
  }
  Room bounds = room(extended.parameters, extended.theta, units);
  // A linearisation far from null is trusted for about a factor of two.
  for (Eigen::Index p = static_cast<Eigen::Index>(stage.parameters.size()); p < units.size(); ++p) {
    bounds.lower[p] = std::max(bounds.lower[p], -1.0);
    bounds.upper[p] = std::min(bounds.upper[p], 1.0);
  }
  const Prior known = prior(extended.parameters, units, extended.theta);
  hypothesis.step = solve_chosen(train, chosen, known, bounds);
  hypothesis.promised_train = promised_square(train, chosen, hypothesis.step) / part.train_share;
  hypothesis.promised_held_out = promised_square(held_out, chosen, hypothesis.step) / part.held_out_share;
}

void sort_by_promise(std::vector<Hypothesis>& hypotheses) {
  std::stable_sort(hypotheses.begin(), hypotheses.end(),
                   [](const Hypothesis& a, const Hypothesis& b) { return a.promised() < b.promised(); });
}

/// The best of the laws that had to be linearised away from their null value are linearised once more where
/// their promise leads: theirs is the promise that a straight line keeps worst.
void look_again(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                const Part& part, const Progress& progress, std::vector<Hypothesis>& found) {
  constexpr std::size_t kLooks = 12;
  std::vector<int> seen;
  for (std::size_t h = 0; h < found.size() && seen.size() < kLooks; ++h) {
    if (found[h].tangent || std::find(seen.begin(), seen.end(), found[h].candidate) != seen.end()) {
      continue;
    }
    seen.push_back(found[h].candidate);
    const Candidate& candidate = candidates[static_cast<std::size_t>(found[h].candidate)];
    progress("looking again at " + candidate.label(), 0.95);
    const Extended extended = extend(stage, candidate, found[h].start);
    const Eigen::VectorXd theta = promised_theta(extended, found[h]);
    Hypothesis again = found[h];
    again.start = with_values(extended.model, extended.parameters, theta).effects.back().numbers();
    if (candidate.law->is_null(again.start.data())) {
      continue;
    }
    try {
      screen_start(stage, candidates, again, data, part);
      if (again.promised() < found[h].promised()) {
        found[h] = std::move(again);
      }
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      continue;  // not to be integrated there
    }
  }
  sort_by_promise(found);
}

}  // namespace

Extended extend(const Stage& stage, const Candidate& candidate, const effects::Values& values) {
  Extended extended{with_values(stage.model, stage.parameters, stage.estimate.theta), stage.parameters, {}};
  extended.model.effects.push_back(make_use(candidate, values));
  const bool angular = stage.model.place_is_angular(candidate.place, candidate.at);
  for (FreeParameter& parameter :
       searched_parameters_of(candidate, extended.model.effects.back(),
                              static_cast<int>(extended.model.effects.size()) - 1, angular)) {
    extended.parameters.push_back(std::move(parameter));
  }
  extended.theta = values_of(extended.model, extended.parameters);
  return extended;
}

Eigen::VectorXd promised_theta(const Extended& extended, const Hypothesis& hypothesis) {
  const Eigen::VectorXd units = search_units(extended.parameters, extended.theta);
  Eigen::VectorXd theta = extended.theta;
  for (Eigen::Index p = 0; p < theta.size(); ++p) {
    const FreeParameter& parameter = extended.parameters[static_cast<std::size_t>(p)];
    const double search = to_search(parameter.scale, theta[p]) + units[p] * hypothesis.step[p];
    const double value = from_search(parameter.scale, search);
    if (std::isfinite(value)) {
      theta[p] = std::clamp(value, parameter.lower, parameter.upper);
    }
  }
  return theta;
}

std::vector<Hypothesis> screen(const Stage& stage, const std::vector<Candidate>& candidates, const Data& data,
                               const Progress& progress) {
  std::vector<Hypothesis> tangents;
  std::vector<Hypothesis> starts;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    for (const effects::Values& start : candidates[c].law->starts(candidates[c].scales)) {
      Hypothesis hypothesis;
      hypothesis.candidate = static_cast<int>(c);
      hypothesis.start = start;
      hypothesis.tangent = has_tangent(candidates[c], start);
      (hypothesis.tangent ? tangents : starts).push_back(std::move(hypothesis));
    }
  }
  progress("screening " + std::to_string(tangents.size()) + " linear candidates", 0.0);
  std::vector<Hypothesis> found = screen_tangents(stage, candidates, tangents, data);
  const std::vector<int> windows = thinned(data);
  const Part part{windows, share_of_error(stage, windows, data, Role::train),
                  share_of_error(stage, windows, data, Role::held_out)};
  for (std::size_t s = 0; s < starts.size(); ++s) {
    const Candidate& candidate = candidates[static_cast<std::size_t>(starts[s].candidate)];
    progress("screening " + candidate.label(),
             static_cast<double>(s + 1) / static_cast<double>(starts.size() + 1));
    try {
      screen_start(stage, candidates, starts[s], data, part);
      if (std::isfinite(starts[s].promised())) {
        found.push_back(std::move(starts[s]));
      }
    } catch (const Stopped&) {
      throw;
    } catch (const std::runtime_error&) {
      continue;  // this start cannot be integrated on these trials: it is no explanation of them
    }
  }
  sort_by_promise(found);
  look_again(stage, candidates, data, part, progress, found);
  return found;
}

}  // namespace plumbline::validation
