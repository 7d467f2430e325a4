// Counts every allocation of the process, the loaded libraries' too: after create() there is none.
#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <vector>

#include "controllers/host/loaded_controller.h"

#if !defined(__SANITIZE_ADDRESS__)

namespace {
std::atomic<long> allocations{0};
}

// This program's names stand before libc's, for every library in the process.
extern "C" {
void* __libc_malloc(std::size_t size);                 // NOLINT
void* __libc_calloc(std::size_t n, std::size_t size);  // NOLINT
void* __libc_realloc(void* p, std::size_t size);       // NOLINT
void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t n, std::size_t size) {
  ++allocations;
  return __libc_calloc(n, size);
}
void* realloc(void* p, std::size_t size) {
  ++allocations;
  return __libc_realloc(p, size);
}
}

namespace plumbline::controllers {
namespace {

/// Constants that every controller takes: its own limits' middle, or 1.
std::vector<double> some_constants(const LoadedController& loaded) {
  std::vector<double> constants;
  for (const plumbline_port& port : loaded.constants()) {
    const bool open = !(port.lower > -1e300 && port.upper < 1e300);
    const std::string name = port.name;
    const bool from = name.size() > 5 && name.substr(name.size() - 5) == "_from";
    constants.push_back(from ? -1e9 : open ? 1.0 : port.lower);
  }
  return constants;
}

class Allocations : public testing::TestWithParam<const char*> {};

TEST_P(Allocations, NoneInStepResetAndMemory) {
  const LoadedController loaded(find_controller(GetParam()));
  std::vector<double> constants = some_constants(loaded);
  for (std::size_t c = 0; c < constants.size(); ++c) {
    const std::string name = loaded.constants()[c].name;
    constants[c] = name.rfind("torque_limit", 0) == 0 ? 10.0 : constants[c];
    constants[c] = name.size() > 3 && name.substr(name.size() - 3) == "_to" ? 1e9 : constants[c];
  }
  const std::vector<double> scales(loaded.inputs().size(), 1e-3);
  ControllerInstance instance(loaded, 1e-3, constants, scales);
  std::vector<double> in(loaded.inputs().size()), out(loaded.outputs().size()), log(loaded.log().size());
  const long before = allocations;
  for (int k = 0; k < 3000; ++k) {
    for (std::size_t i = 0; i < in.size(); ++i) {
      const bool is_switch = loaded.api().inputs[i].kind == PLUMBLINE_SWITCH;
      in[i] = is_switch ? (k / 200 % 2) : (k * static_cast<int>(i + 1)) % 97;
    }
    instance.step(in.data(), out.data(), log.data());
    if (k == 2000) {
      instance.reset();
    }
  }
  EXPECT_EQ(allocations - before, 0);
}

INSTANTIATE_TEST_SUITE_P(Libraries, Allocations,
                         testing::Values("mabel_hopping", "hold_position", "atrias_running",
                                         "thumper_running"));

TEST(Allocations, AreCountedInALoadedLibraryToo) {
  const LoadedController loaded(find_controller("hold_position"));
  const long before = allocations;
  const ControllerInstance instance(loaded, 1e-3, {0.0, 1.0, 1.0},
                                    {1.0});  // create() calls the library's malloc
  EXPECT_GT(allocations - before, 0);
}

}  // namespace
}  // namespace plumbline::controllers

#endif
