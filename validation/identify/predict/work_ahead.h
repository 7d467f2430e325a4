// Long work whose results are kept, done ahead by several ranks.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/identify/predict/problem.h"

namespace plumbline::validation {

/// Work that will be asked for soon, and that keeps its results (kept_results.h).
struct Ahead {
  std::string name;
  std::function<void()> work;
};

/// Has the pieces done by the ranks that the data's kept results are shared among, each piece by one. What
/// they kept is then known to all ranks: who asks for it finds it, and the answer is what it would have been
/// without. Pieces that throw std::runtime_error leave no result, and whoever asks meets the error himself.
/// With one rank nothing is done. Throws Stopped.
void work_ahead(const Data& data, const std::vector<Ahead>& pieces);

/// How many pieces can be done at a time; 1: work_ahead() does nothing.
int ranks_of(const Data& data);

}  // namespace plumbline::validation
