#include "validation/diagnose/choose.h"

#include <algorithm>
#include <cmath>

namespace plumbline::validation {
namespace {

/// Error of a refit that counts for choosing: train and held-out together.
double together(const Refit& refit) { return std::sqrt(refit.square()); }

/// How much a refit takes for granted: its fitted parameters, then its laws' choices and numerical constants.
std::pair<int, int> complexity(const Refit& refit) {
  int constants = 0;
  for (const int effect : refit.added) {
    constants += refit.extended.model.effects[static_cast<std::size_t>(effect)].law->parameter_count();
  }
  return {refit.own, constants};
}

/// Refits that predict as well as the best, or nearly: a simpler law is named before them.
std::vector<std::size_t> near_best(const std::vector<Refit>& refits, const DiagnoseOptions& options) {
  std::vector<std::size_t> near;
  for (std::size_t i = 0; i < refits.size(); ++i) {
    if (together(refits[i]) < (1.0 + options.simpler) * together(refits.front())) {
      near.push_back(i);
    }
  }
  return near;
}

/// Relative difference of squared errors that the searches themselves may leave.
constexpr double kSame = 2e-3;

/// What these data cannot tell from the named law: of no more parameters those that win in a fair share of
/// resamples or leave the same error; of more parameters those that are surely better, if only by little.
std::vector<std::size_t> rivals_of(std::size_t named, const std::vector<Refit>& refits, const Data& data,
                                   const DiagnoseOptions& options) {
  std::vector<std::size_t> rivals;
  for (std::size_t i = 0; i < refits.size(); ++i) {
    if (i == named) {
      continue;
    }
    const double wins = share_better(refits[i], refits[named], data, options);
    const double ratio = refits[i].square() / refits[named].square();
    const bool smaller = refits[i].own <= refits[named].own;
    if (smaller ? wins > kFair || ratio < 1.0 + kSame : wins > 1.0 - kFair && ratio < 1.0 - kSame) {
      rivals.push_back(i);
    }
  }
  return rivals;
}

}  // namespace

double judged(const Scores& scores, const Data& data) {
  return data.has(Role::held_out) ? scores.held_out : scores.train;
}

Choice choose(const Stage& stage, const std::vector<Refit>& refits, const Data& data,
              const DiagnoseOptions& options) {
  Choice choice;
  if (refits.empty()) {
    return choice;
  }
  choice.shares = selected_shares(stage, refits, data, options);
  std::vector<std::size_t> near = near_best(refits, options);
  for (const std::size_t i : near) {
    choice.share += choice.shares[i];
  }
  for (std::size_t i = 0; i < refits.size(); ++i) {
    const bool is_near = std::find(near.begin(), near.end(), i) != near.end();
    choice.objections.push_back(
        objection(stage, refits[i], is_near ? choice.share : choice.shares[i], data, options));
  }
  std::stable_sort(near.begin(), near.end(), [&](std::size_t a, std::size_t b) {
    return complexity(refits[a]) < complexity(refits[b]);
  });
  const auto named =
      std::find_if(near.begin(), near.end(), [&](std::size_t i) { return choice.objections[i].empty(); });
  if (named != near.end()) {
    choice.named = static_cast<int>(*named);
    choice.rivals = rivals_of(*named, refits, data, options);
  }
  return choice;
}

}  // namespace plumbline::validation
