#include "validation/identify/diagnose/part.h"

#include <algorithm>

namespace plumbline::validation {
namespace {

double square_of(const Stage& stage, int window) {
  return stage.estimate.predicted.square[static_cast<std::size_t>(window)].sum();
}

/// Squared error of the stage on some of the windows as a share of that on all.
double share_of_error(const Stage& stage, const std::vector<int>& windows, const Data& data, Role role) {
  const auto mean = [&](const std::vector<int>& some) {
    double sum = 0.0;
    double samples = 0.0;
    for (const int w : some) {
      const auto i = static_cast<std::size_t>(w);
      if (data.role(i) == role) {
        sum += square_of(stage, w);
        samples += static_cast<double>(data.windows[i].count * stage.estimate.predicted.square[i].size());
      }
    }
    return samples > 0.0 ? sum / samples : 0.0;
  };
  const double all = mean(data.windows_of(role));
  const double part = mean(windows);
  return all > 0.0 && part > 0.0 ? part / all : 1.0;
}

/// `windows` is sorted by error, the largest first.
int upper_quartile(const std::vector<int>& windows) { return windows[windows.size() / 4]; }

}  // namespace

Part part_of(const Stage& stage, const std::vector<int>& windows, const Data& data) {
  return {windows, share_of_error(stage, windows, data, Role::train),
          share_of_error(stage, windows, data, Role::held_out)};
}

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

Part enough_to_tell(const Stage& stage, const Data& data) {
  constexpr std::size_t kEnough = 16;
  const std::vector<int> all = data.all_windows();
  if (all.size() <= kEnough) {
    return part_of(stage, all, data);
  }
  if (data.has_segments()) {
    return part_of(stage, telling(stage, std::max<std::size_t>(2, all.size() / kEnough), all, data), data);
  }
  std::vector<int> every_second;
  for (std::size_t w = 0; w < all.size(); w += 2) {
    every_second.push_back(all[w]);
  }
  return part_of(stage, every_second, data);
}

}  // namespace plumbline::validation
