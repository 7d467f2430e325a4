// Of a sorted list with several of a kind the best of each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace plumbline::validation {

/// In their order the first of those that `is_same` takes for one; at most `most`.
template <typename T, typename Same>
std::vector<T> first_of_each(std::vector<T> all, const Same& is_same,
                             std::size_t most = std::numeric_limits<std::size_t>::max()) {
  std::vector<T> firsts;
  for (T& one : all) {
    const bool known =
        std::any_of(firsts.begin(), firsts.end(), [&](const T& other) { return is_same(one, other); });
    if (!known && firsts.size() < most) {
      firsts.push_back(std::move(one));
    }
  }
  return firsts;
}

}  // namespace plumbline::validation
