// fuzz_readers SECONDS SEED [TARGET [INPUTS]]: damages good inputs of every reader until the time is over, or
// until each has had so many. What a reader does not handle is kept in tests/corpus/TARGET; when a reader
// crashes or hangs, the input is the last one below the folder that the program names first.
#include <sys/time.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>

#include "tests/fuzz/mutator.h"
#include "tests/fuzz/reader_targets.h"

namespace {

using plumbline::test::Mutator;
using plumbline::test::ReaderTarget;

/// Ends the program when this much processor time passes before the next call; 0: no end.
void end_after(int seconds) {
  itimerval limit{};
  limit.it_value.tv_sec = seconds;
  setitimer(ITIMER_PROF, &limit, nullptr);
}

void keep(const ReaderTarget& target, std::uint64_t seed, long number, const std::string& text) {
  const std::filesystem::path folder = std::filesystem::path(PLUMBLINE_ROOT "/tests/corpus") / target.name;
  std::filesystem::create_directories(folder);
  const std::string name = "seed" + std::to_string(seed) + "-" + std::to_string(number);
  std::ofstream(folder / name, std::ios::binary) << text;
}

/// Tries inputs for a while; returns how many went wrong.
int fuzz(const ReaderTarget& target, std::uint64_t seed, double seconds, long most) {
  Mutator mutator(seed);
  const auto start = std::chrono::steady_clock::now();
  const auto left = [&] {
    return seconds - std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  int wrong = 0;
  long number = 0;
  while (number < most && left() > 0.0) {
    const std::string text =
        mutator.mutate(target.seeds[static_cast<std::size_t>(number) % target.seeds.size()]);
    end_after(20);  // a reader that hangs ends the program, the input stays
    const std::string reason = target.check(text);
    end_after(0);
    if (!reason.empty()) {
      keep(target, seed, number, text);
      std::cout << target.name << " input " << number << ": " << reason << std::endl;
      ++wrong;
    }
    ++number;
  }
  std::cout << target.name << ": " << number << " inputs, " << wrong << " not handled" << std::endl;
  return wrong;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::cerr << "usage: fuzz_readers SECONDS SEED [TARGET [INPUTS]]\n";
    return 2;
  }
  const double seconds = std::atof(argv[1]);
  const std::uint64_t seed = std::strtoull(argv[2], nullptr, 10);
  const std::string only = argc > 3 ? argv[3] : "";
  const long most = argc > 4 ? std::atol(argv[4]) : std::numeric_limits<long>::max();
  const std::string folder =
      (std::filesystem::temp_directory_path() / ("plumbline-fuzz-" + std::to_string(getpid()))).string();
  std::filesystem::create_directories(folder);
  std::cout << "inputs in " << folder << std::endl;
  const std::vector<ReaderTarget> targets = plumbline::test::reader_targets(folder);
  int wrong = 0;
  for (const ReaderTarget& target : targets) {
    if (only.empty() || only == target.name) {
      wrong +=
          fuzz(target, seed, only.empty() ? seconds / static_cast<double>(targets.size()) : seconds, most);
    }
  }
  std::filesystem::remove_all(folder);
  return wrong == 0 ? 0 : 1;
}
