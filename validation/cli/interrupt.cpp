#include "validation/cli/interrupt.h"

#include <csignal>

namespace plumbline::cli {
namespace {

validation::StopFlag& flag() {
  static validation::StopFlag the_flag;
  return the_flag;
}

void on_interrupt(int signal) {
  if (flag().raised.exchange(true)) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

const validation::StopFlag& stop_flag() { return flag(); }

void catch_interrupts() {
  flag();
  std::signal(SIGINT, on_interrupt);
  std::signal(SIGTERM, on_interrupt);
}

}  // namespace plumbline::cli
