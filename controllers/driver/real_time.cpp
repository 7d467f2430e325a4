#include "controllers/driver/real_time.h"

#include <fcntl.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <cstring>

namespace plumbline::driver {
namespace {

constexpr std::size_t kStack = 256U << 10U;

std::string failed(const char* what) { return std::string(what) + ": " + std::strerror(errno); }

}  // namespace

__attribute__((noinline)) void touch_stack() {
  volatile std::uint8_t pages[kStack];
  for (std::size_t k = 0; k < kStack; k += 1024) pages[k] = 1;
  (void)pages[0];
}

std::vector<std::string> make_real_time(const RealTime& wanted) {
  std::vector<std::string> missing;
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0)
    missing.push_back(failed("memory cannot be locked (mlockall)"));
  touch_stack();
  if (wanted.core >= 0) {
    cpu_set_t cores;
    CPU_ZERO(&cores);
    CPU_SET(static_cast<unsigned>(wanted.core), &cores);
    if (sched_setaffinity(0, sizeof cores, &cores) != 0)
      missing.push_back(failed("one core (sched_setaffinity)"));
  }
  sched_param parameter{};
  parameter.sched_priority = wanted.priority;
  if (sched_setscheduler(0, SCHED_FIFO, &parameter) != 0) {
    missing.push_back(failed("real-time priority (SCHED_FIFO)"));
  }
  prctl(PR_SET_TIMERSLACK, 1UL);
  // Held open for as long as the process lives: the processor stays out of deep sleep. Not every system has
  // it.
  static int latency = -1;
  if (latency < 0) latency = open("/dev/cpu_dma_latency", O_WRONLY | O_CLOEXEC);
  const std::int32_t none = 0;
  if (latency >= 0 && write(latency, &none, sizeof none) < 0) close(latency);
  return missing;
}

}  // namespace plumbline::driver
