// Waiting for a number in memory that two processes share.
#pragma once

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <climits>
#include <cstdint>
#include <ctime>

namespace plumbline::driver {

/// Sleeps while `word` is `value`, until CLOCK_MONOTONIC shows `deadline` (ns; below 0: without end), a wake
/// or a signal. The caller looks again at what it waits for.
inline void futex_wait(std::atomic<std::uint32_t>& word, std::uint32_t value,
                       std::int64_t deadline) noexcept {
  timespec time{};
  time.tv_sec = deadline / 1000000000;
  time.tv_nsec = deadline % 1000000000;
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAIT_BITSET, value,
          deadline < 0 ? nullptr : &time, nullptr, FUTEX_BITSET_MATCH_ANY);
}

inline void futex_wake(std::atomic<std::uint32_t>& word) noexcept {
  syscall(SYS_futex, reinterpret_cast<std::uint32_t*>(&word), FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace plumbline::driver
