#include "validation/identify/diagnose/one_place.h"

#include <algorithm>

#include "validation/identify/diagnose/family.h"

namespace plumbline::validation {

std::optional<OnePlace> at_one_place(std::vector<LawShare> shares, const model::Model& model,
                                     const Policy& policy) {
  shares.erase(std::remove_if(shares.begin(), shares.end(),
                              [&](const LawShare& one) { return one.share < policy.fair; }),
               shares.end());
  std::stable_sort(shares.begin(), shares.end(),
                   [](const LawShare& a, const LawShare& b) { return a.share > b.share; });
  const TiedPlaces places(model);
  OnePlace most;
  for (const LawShare& first : shares) {
    OnePlace here{first.at, 0.0, {}};
    for (const LawShare& one : shares) {
      if (places.are_one(first.at, one.at)) {
        here.share += one.share;
        here.laws.push_back(one);
      }
    }
    if (here.share > most.share) {
      most = std::move(here);
    }
  }
  const bool is_sure = most.laws.size() > 1 && most.share >= policy.stable;
  return is_sure ? std::optional(std::move(most)) : std::nullopt;
}

std::optional<OnePlace> at_one_place(const std::vector<RankRow>& leads, const model::Model& model,
                                     const Policy& policy) {
  std::vector<LawShare> shares;
  for (const RankRow& row : leads) {
    if (row.refitted) {
      shares.push_back({{row.effect, row.at}, row.selected_share});
    }
  }
  return at_one_place(std::move(shares), model, policy);
}

}  // namespace plumbline::validation
