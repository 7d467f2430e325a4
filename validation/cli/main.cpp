#include <fmt/core.h>

#include <cstdio>

#include "simulator/trace/error.h"
#include "validation/cli/commands.h"
#include "validation/cli/interrupt.h"

namespace {

/// One line, whatever the message was.
std::string one_line(std::string text) {
  for (char& c : text) {
    c = c == '\n' ? ' ' : c;
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  plumbline::cli::Outcome outcome;
  CLI::App app{"plumbline: hold a robot's model against its measurements and learn which physics is missing"};
  app.require_subcommand(1);
  app.set_version_flag("--version", PLUMBLINE_VERSION);
  plumbline::cli::catch_interrupts();
  try {
    plumbline::cli::add_effects(app, outcome);
    plumbline::cli::add_check(app, outcome);
    plumbline::cli::add_simulate(app, outcome);
    plumbline::cli::add_hop(app, outcome);
    plumbline::cli::add_validate(app, outcome);
    plumbline::cli::add_compare(app, outcome);
    plumbline::cli::add_fit(app, outcome);
    plumbline::cli::add_diagnose(app, outcome);
    plumbline::cli::add_add(app, outcome);
    plumbline::cli::add_ladder(app, outcome);
    plumbline::cli::add_new_trial(app, outcome);
    plumbline::cli::add_twin(app, outcome);
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help, --version
    }
    fmt::print(stderr, "plumbline: {}\n", one_line(error.what()));
    return 2;
  } catch (const plumbline::InputError& error) {
    fmt::print(stderr, "plumbline: {}\n", one_line(error.what()));
    return 2;
  } catch (const plumbline::validation::Stopped& stopped) {
    fmt::print(stderr, "plumbline: {}\n", stopped.what());
    return 130;
  } catch (const std::exception& error) {
    fmt::print(stderr, "plumbline: {}\n", one_line(error.what()));
    return 1;
  }
  return outcome.status;
}
