// Subcommands that lead from a controller to a robot. Each adds itself to the application, as those of
// commands.h do.
#pragma once

#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_certify(CLI::App& app, Outcome& outcome);
void add_verify(CLI::App& app, Outcome& outcome);
void add_key(CLI::App& app, Outcome& outcome);
void add_robot(CLI::App& app, Outcome& outcome);

}  // namespace plumbline::cli
