// The command `plumbline running`.
#pragma once

#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_running(CLI::App& app, Outcome& outcome);

}  // namespace plumbline::cli
