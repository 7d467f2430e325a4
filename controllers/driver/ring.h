// A queue from one thread to one other that never waits and never allocates.
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

namespace plumbline::driver {

/// Rows of `width` numbers. push() drops the row when the queue is full, and counts it.
class Ring {
 public:
  Ring(std::size_t width, std::size_t rows) : width_(width), rows_(rows), values_(width * rows, 0.0) {}

  /// Where the next row is to be written; null when the queue is full (the row is lost then).
  double* begin_push() noexcept {
    const std::uint64_t next = written_.load(std::memory_order_relaxed);
    if (next - read_.load(std::memory_order_acquire) >= rows_) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return nullptr;
    }
    return &values_[(next % rows_) * width_];
  }
  void end_push() noexcept { written_.fetch_add(1, std::memory_order_release); }

  /// The oldest row; null when there is none.
  const double* front() const noexcept {
    const std::uint64_t next = read_.load(std::memory_order_relaxed);
    if (written_.load(std::memory_order_acquire) == next) return nullptr;
    return &values_[(next % rows_) * width_];
  }
  void pop() noexcept { read_.fetch_add(1, std::memory_order_release); }
  std::uint64_t lost() const noexcept { return lost_.load(); }

 private:
  std::size_t width_, rows_;
  std::vector<double> values_;
  std::atomic<std::uint64_t> written_{0}, read_{0}, lost_{0};
};

}  // namespace plumbline::driver
