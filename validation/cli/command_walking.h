// Commands on walking: `plumbline gait`, `plumbline step-down`.
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::cli {

struct Outcome;
void add_gait(CLI::App& app, Outcome& outcome);
void add_step_down(CLI::App& app);

}  // namespace plumbline::cli
