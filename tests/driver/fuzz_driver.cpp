// By hand, all targets or one (packet, certificate, body, constants, supervisor):
//   fuzz_driver COUNT SEED CONTROLLER.so [TARGET [CERTIFICATE]]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/driver/fuzz_targets.h"

int main(int argc, char** argv) {
  if (argc < 4 || argc > 6) {
    std::fprintf(stderr, "usage: fuzz_driver COUNT SEED CONTROLLER.so [TARGET [CERTIFICATE]]\n");
    return 2;
  }
  const auto count = static_cast<std::uint64_t>(std::strtod(argv[1], nullptr));
  const auto begun = std::chrono::steady_clock::now();
  std::uint64_t created = 0;
  try {
    plumbline::driver::FuzzTargets targets(std::strtoull(argv[2], nullptr, 10), argv[3],
                                           argc > 5 ? argv[5] : "");
    if (argc > 4) {
      targets.run_only(argv[4], count);
    } else {
      targets.run(count);
    }
    created = targets.created();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz_driver: %s\n", error.what());
    return 1;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  std::printf(
      "%llu inputs in %.0f s, nothing crashed, hung or was accepted wrongly; constants taken %llu times\n",
      static_cast<unsigned long long>(count), seconds, static_cast<unsigned long long>(created));
  return 0;
}
