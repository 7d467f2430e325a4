// Ctrl-C: the first asks the work to end cleanly and keep what is finished, the second ends at once.
#pragma once

#include "validation/identify/predict/problem.h"

namespace plumbline::cli {

/// The flag that the signal handler raises; a signal can reach nothing but static storage.
const validation::StopFlag& stop_flag();
void catch_interrupts();

}  // namespace plumbline::cli
