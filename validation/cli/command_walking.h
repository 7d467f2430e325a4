// Commands on walking: `plumbline study gait`, `plumbline study step-down`.
#pragma once

#include <CLI/CLI.hpp>

namespace plumbline::cli {

struct Outcome;
void add_gait(CLI::App& app, Outcome& outcome);
void add_step_down(CLI::App& app);

}  // namespace plumbline::cli
