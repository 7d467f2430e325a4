// By hand: fuzz_driver COUNT SEED CONTROLLER.so [packet|certificate|body|constants|supervisor]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "tests/driver/fuzz_targets.h"

int main(int argc, char** argv) {
  if (argc != 4 && argc != 5) {
    std::fprintf(
        stderr,
        "usage: fuzz_driver COUNT SEED CONTROLLER.so [packet|certificate|body|constants|supervisor]\n");
    return 2;
  }
  const auto count = static_cast<std::uint64_t>(std::strtod(argv[1], nullptr));
  const auto begun = std::chrono::steady_clock::now();
  try {
    plumbline::driver::FuzzTargets targets(std::strtoull(argv[2], nullptr, 10), argv[3]);
    if (argc == 5) {
      targets.run_only(argv[4], count);
    } else {
      targets.run(count);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "fuzz_driver: %s\n", error.what());
    return 1;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  std::printf("%llu inputs in %.0f s, nothing crashed, hung or was accepted wrongly\n",
              static_cast<unsigned long long>(count), seconds);
  return 0;
}
