// How long things took: counted while they happen, without allocation.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace plumbline::driver {

/// Times in bins of 1 us up to 10 ms; what is longer is counted in the last one, and `largest` knows it.
class Histogram {
 public:
  static constexpr int bins = 10001;

  void add(std::int64_t nanoseconds) noexcept {
    const std::int64_t us = std::max<std::int64_t>(nanoseconds, 0) / 1000;
    ++counts_[static_cast<std::size_t>(std::min<std::int64_t>(us, bins - 1))];
    ++total_;
    largest_ = std::max(largest_, nanoseconds);
  }
  std::uint64_t total() const noexcept { return total_; }
  std::int64_t largest() const noexcept { return largest_; }
  std::uint64_t count(int bin) const noexcept { return counts_[static_cast<std::size_t>(bin)]; }
  /// Upper edge of the bin, us, below which this share of all lies; the largest one where that is the last
  /// bin.
  double quantile(double share) const noexcept {
    std::uint64_t below = 0;
    for (int bin = 0; bin < bins - 1; ++bin) {
      below += count(bin);
      if (total_ > 0 && static_cast<double>(below) >= share * static_cast<double>(total_)) return bin + 1;
    }
    return static_cast<double>(largest_) / 1000.0;
  }

 private:
  std::array<std::uint64_t, bins> counts_{};
  std::uint64_t total_ = 0;
  std::int64_t largest_ = 0;
};

}  // namespace plumbline::driver
