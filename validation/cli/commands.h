// The commands of `plumbline`: each file command_NAME.cpp registers one.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace plumbline::cli {

/// What the program returns: 0 done, 1 the check asked for did not hold, 2 bad input or usage.
struct Outcome {
  int status = 0;
};

void add_effects(CLI::App& app, Outcome& outcome);
void add_check(CLI::App& app, Outcome& outcome);
void add_simulate(CLI::App& app, Outcome& outcome);
void add_validate(CLI::App& app, Outcome& outcome);
void add_tune(CLI::App& app, Outcome& outcome);
void add_compare(CLI::App& app, Outcome& outcome);
void add_fit(CLI::App& app, Outcome& outcome);
void add_diagnose(CLI::App& app, Outcome& outcome);
void add_add(CLI::App& app, Outcome& outcome);
void add_ladder(CLI::App& app, Outcome& outcome);
/// `words`: the command line, for whoever wants to repeat it.
void add_report(CLI::App& app, const std::vector<std::string>& words);
void add_suggest(CLI::App& app, Outcome& outcome);
void add_new_trial(CLI::App& app, Outcome& outcome);
void add_new_model(CLI::App& app, Outcome& outcome);
void add_export(CLI::App& app, Outcome& outcome);
void add_twin(CLI::App& app, Outcome& outcome);
void add_render(CLI::App& app, Outcome& outcome);
void add_spring_mass(CLI::App& app, Outcome& outcome);
void add_running(CLI::App& app, Outcome& outcome);
void add_batch(CLI::App& app, Outcome& outcome);

}  // namespace plumbline::cli
