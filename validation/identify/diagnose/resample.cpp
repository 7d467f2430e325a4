#include "validation/identify/diagnose/resample.h"

#include <algorithm>
#include <random>

namespace plumbline::validation {
namespace {

/// Squared scores from per-window squares weighted by how often each window was drawn.
Scores drawn_scores(const Data& data, const std::vector<Eigen::VectorXd>& square,
                    const std::vector<int>& times) {
  std::vector<Eigen::VectorXd> weighted = square;
  for (std::size_t w = 0; w < square.size(); ++w) {
    weighted[w] = square[w] * static_cast<double>(times[w]);
  }
  return score(data, weighted);
}

double drawn_square(const Data& data, const std::vector<Eigen::VectorXd>& square,
                    const std::vector<int>& times) {
  return drawn_scores(data, square, times).square();
}

/// How often each window is drawn: with replacement within each role's windows.
std::vector<int> draw(const Data& data, std::mt19937_64& random) {
  std::vector<int> times(data.windows.size(), 0);
  for (const Role role : {Role::train, Role::held_out}) {
    const std::vector<int> windows = data.windows_of(role);
    if (windows.empty()) {
      continue;
    }
    std::uniform_int_distribution<std::size_t> pick(0, windows.size() - 1);
    for (std::size_t i = 0; i < windows.size(); ++i) {
      ++times[static_cast<std::size_t>(windows[pick(random)])];
    }
  }
  return times;
}

}  // namespace

std::vector<double> selected_shares(const Stage& stage, const std::vector<Refit>& refits,
                                    const std::vector<std::size_t>& contenders, const Data& data,
                                    const Policy& policy) {
  std::mt19937_64 random(policy.seed);
  std::vector<double> shares(refits.size() + 1, 0.0);
  const double keep = (1.0 - policy.material) * (1.0 - policy.material);
  for (int r = 0; r < policy.resamples; ++r) {
    const std::vector<int> times = draw(data, random);
    double best = keep * drawn_square(data, stage.estimate.predicted.square, times);
    std::size_t winner = refits.size();
    for (const std::size_t i : contenders) {
      const double square = drawn_square(data, refits[i].estimate.predicted.square, times);
      if (square < best) {
        best = square;
        winner = i;
      }
    }
    shares[winner] += 1.0 / policy.resamples;
  }
  return shares;
}

double share_better(const Refit& other, const Refit& best, const Data& data, const Policy& policy) {
  std::mt19937_64 random(policy.seed);
  double share = 0.0;
  for (int r = 0; r < policy.resamples; ++r) {
    const std::vector<int> times = draw(data, random);
    if (drawn_square(data, other.estimate.predicted.square, times) <
        drawn_square(data, best.estimate.predicted.square, times)) {
      share += 1.0 / policy.resamples;
    }
  }
  return share;
}

std::pair<double, double> resampled_error(const Refit& refit, Role role, const Data& data,
                                          const Policy& policy) {
  std::mt19937_64 random(policy.seed);
  std::vector<double> errors;
  for (int r = 0; r < policy.resamples; ++r) {
    const Scores scores = drawn_scores(data, refit.estimate.predicted.square, draw(data, random));
    errors.push_back(role == Role::train ? scores.train : scores.held_out);
  }
  std::sort(errors.begin(), errors.end());
  const auto tail = errors.size() / 20;
  return {errors[tail], errors[errors.size() - 1 - tail]};
}

}  // namespace plumbline::validation
