#include "validation/identify/diagnose/race.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "validation/identify/diagnose/refit_one.h"
#include "validation/identify/predict/work_ahead.h"

namespace plumbline::validation {

std::vector<const Hypothesis*> race(const Stage& stage, const std::vector<Candidate>& candidates,
                                    const std::vector<const Hypothesis*>& entrants, const Data& data,
                                    const Progress& progress) {
  constexpr std::size_t kWinners = 3;
  constexpr Effort kShort{4, false};
  const auto candidate_of = [&](const Hypothesis* one) -> const Candidate& {
    return candidates[static_cast<std::size_t>(one->candidate)];
  };
  const auto lap = [&](const Hypothesis* one) {
    return square_on_some(stage, candidate_of(one), *one, data, kShort);
  };
  std::vector<Ahead> pieces;
  pieces.reserve(entrants.size());
  for (const Hypothesis* one : entrants) {
    pieces.push_back({"trying " + candidate_of(one).label(), [&lap, one] { lap(one); }});
  }
  work_ahead(data, pieces);
  std::vector<std::pair<double, const Hypothesis*>> laps;
  for (const Hypothesis* one : entrants) {
    progress("trying " + candidate_of(one).label(), 0.8);
    laps.emplace_back(lap(one), one);
  }
  std::stable_sort(laps.begin(), laps.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<const Hypothesis*> winners;
  for (const auto& [square, one] : laps) {
    if (winners.size() < kWinners && std::isfinite(square)) {
      winners.push_back(one);
    }
  }
  return winners;
}

}  // namespace plumbline::validation
