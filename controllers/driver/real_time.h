// What keeps a thread on time: priority, memory that is there, one core, a processor that stays awake.
#pragma once

#include <string>
#include <vector>

namespace plumbline::driver {

struct RealTime {
  int priority = 80;  ///< of SCHED_FIFO
  int core = -1;      ///< -1: any
};

/// For the calling thread and its process; returns one line for each thing that the system did not allow.
/// Empty: all is as asked.
std::vector<std::string> make_real_time(const RealTime& wanted);

/// Touches `bytes` of the calling thread's stack, so that no page is missing later.
void touch_stack();

}  // namespace plumbline::driver
