// controller_probe LIBRARY INPUT: steps a controller through recorded inputs, counts its allocations, takes
// its time. The program's own malloc stands before the C library's for the controller too, and counts.
#include <dlfcn.h>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <vector>

#include "controllers/controller.h"

namespace {
std::atomic<bool> counting{false};
std::atomic<long> allocations{0};
void count() {
  if (counting.load(std::memory_order_relaxed)) allocations.fetch_add(1, std::memory_order_relaxed);
}
}  // namespace

// glibc's own, under the names that it keeps for this purpose.
extern "C" {
void* __libc_malloc(std::size_t size);                 // NOLINT(bugprone-reserved-identifier)
void __libc_free(void* memory);                        // NOLINT(bugprone-reserved-identifier)
void* __libc_calloc(std::size_t n, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
void* __libc_realloc(void* memory, std::size_t size);  // NOLINT(bugprone-reserved-identifier)
void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void free(void* memory) {
  if (memory != nullptr) count();
  __libc_free(memory);
}
void* calloc(std::size_t n, std::size_t size) {
  count();
  return __libc_calloc(n, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
}

namespace {

double seconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double read(std::ifstream& in) {
  double value = 0.0;
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  return value;
}

std::vector<double> read(std::ifstream& in, std::size_t n) {
  std::vector<double> values(n);
  for (double& value : values) value = read(in);
  return values;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  std::ifstream in(argv[2], std::ios::binary);
  const double period = read(in);
  const auto constant_count = static_cast<std::size_t>(read(in));
  const auto inputs = static_cast<std::size_t>(read(in));
  const auto samples = static_cast<std::size_t>(read(in));
  const auto steps = static_cast<std::size_t>(read(in));
  const std::vector<double> constants = read(in, constant_count), scales = read(in, inputs);
  const std::vector<double> values = read(in, inputs * samples);
  void* const library = dlopen(argv[1], RTLD_NOW | RTLD_LOCAL);
  if (!in || library == nullptr || samples == 0) return 1;
  const auto entry =
      reinterpret_cast<decltype(&plumbline_controller)>(dlsym(library, PLUMBLINE_CONTROLLER_SYMBOL));
  if (entry == nullptr) return 1;
  const plumbline_controller_api& api = *entry();
  if (api.input_count != inputs || api.constant_count != constants.size()) return 1;
  char message[256] = "";
  const plumbline_setup setup = {period, constants.data(), scales.data()};
  void* const self = api.create(&setup, message, sizeof message);
  if (self == nullptr) return 1;
  std::vector<double> outputs(api.output_count), log(api.log_count), times(steps);
  api.reset(self);
  int fault = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    if (k % samples == 0) api.reset(self);
    counting = true;
    const double begun = seconds();
    fault = api.step(self, &values[inputs * (k % samples)], outputs.data(), log.data());
    times[k] = seconds() - begun;
    counting = false;
  }
  api.destroy(self);
  std::sort(times.begin(), times.end());
  std::printf(
      "{\"steps\":%zu,\"allocations\":%ld,\"p50\":%.9g,\"p999\":%.9g,\"largest\":%.9g,\"fault\":%d}\n", steps,
      allocations.load(), times[steps / 2], times[steps - 1 - steps / 1000], times[steps - 1], fault);
  return 0;
}
