#include "validation/identify/diagnose/part.h"

#include <algorithm>

namespace plumbline::validation {
namespace {

double square_of(const Stage& stage, int window) {
  return stage.estimate.predicted.square[static_cast<std::size_t>(window)].sum();
}

/// `windows` is sorted by error, the largest first.
int upper_quartile(const std::vector<int>& windows) { return windows[windows.size() / 4]; }

}  // namespace

std::vector<int> telling(const Stage& stage, std::size_t stride, const std::vector<int>& windows,
                         const Data& data) {
  const auto error = [&](int w) { return square_of(stage, w) / readings(data, w); };
  std::vector<int> chosen;
  for (const Role role : {Role::train, Role::held_out}) {
    std::vector<int> block;
    for (const int w : windows) {
      if (data.role(static_cast<std::size_t>(w)) == role) {
        block.push_back(w);
      }
      if (block.size() == stride || (w == windows.back() && !block.empty())) {
        std::stable_sort(block.begin(), block.end(), [&](int a, int b) { return error(a) > error(b); });
        chosen.push_back(upper_quartile(block));
        block.clear();
      }
    }
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

std::vector<int> enough_to_tell(const Stage& stage, const Data& data) {
  constexpr std::size_t kEnough = 16;
  std::vector<int> all = data.all_windows();
  if (all.size() <= kEnough) {
    return all;
  }
  const std::size_t stride = data.has_segments() ? std::max<std::size_t>(2, all.size() / kEnough) : 2;
  return telling(stage, stride, all, data);
}

}  // namespace plumbline::validation
