// Two effects at once: where several are missing, the best single one may be a compromise between them, or
// none may be the best in enough resamples.
#pragma once

#include <vector>

#include "validation/identify/diagnose/refit.h"

namespace plumbline::validation {

/// Two candidates refitted together; the last effects of the refit's model are theirs, in this order.
struct Pair {
  Candidate first, second;
  Refit refit;
};

/// What was tried at a stage.
struct Tried {
  Stage stage;
  std::vector<Candidate> candidates;
  std::vector<Hypothesis> hypotheses;
  std::vector<Refit> refits;  ///< best first
  std::vector<NotRefitted> failed;
};

/// One round from `stage`: candidates of the catalogue that are not in `taken` ("law@place"), screened.
Tried screen_candidates(const Stage& stage, const effects::Catalogue& catalogue,
                        const std::vector<std::string>& taken, const Data& data, const Progress& progress);

/// The best of what was screened, refitted.
void refit_candidates(const Data& data, const Policy& policy, const Progress& progress, Tried& tried);

/// Both.
Tried try_candidates(const Stage& stage, const effects::Catalogue& catalogue,
                     const std::vector<std::string>& taken, const Data& data, const Policy& policy,
                     const Progress& progress);

/// The best pairs from where `tried` began, best first, each pair once: after each of the best single
/// refits whatever helps it most, and of the laws that can be linearised together the pairs that promise
/// most.
std::vector<Pair> look_ahead(const Tried& tried, const effects::Catalogue& catalogue, const Data& data,
                             const Policy& policy, const Progress& progress);

/// Where the best pairs leave nothing, either half of them by itself, refitted from its values in the pair:
/// those that leave nothing alone, and not materially more than the pair. The other half then only helped the
/// search out of a poor minimum.
std::vector<Refit> halves_of(const Tried& tried, const std::vector<Pair>& pairs, const Data& data,
                             const Policy& policy, const Progress& progress);

}  // namespace plumbline::validation
