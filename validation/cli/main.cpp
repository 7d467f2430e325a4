#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "simulator/trace/error.h"
#include "validation/cli/command_walking.h"
#include "validation/cli/commands.h"
#include "validation/cli/driving_commands.h"
#include "validation/cli/interrupt.h"

namespace {

/// One line, whatever the message was.
std::string one_line(std::string text) {
  for (char& c : text) {
    c = c == '\n' ? ' ' : c;
  }
  return text;
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

/// The command line, the program by its own name.
std::vector<std::string> command_words(int argc, char** argv) {
  std::vector<std::string> words{"plumbline"};
  words.insert(words.end(), argv + std::min(argc, 1), argv + argc);
  return words;
}

/// CLI11 says only that a command is required when the one given is unknown.
void refuse_unknown_command(const CLI::App& app, int argc, char** argv) {
  if (argc < 2 || argv[1][0] == '-') {
    return;
  }
  const std::string given = argv[1];
  const std::vector<std::string> known = command_names(app);
  if (std::find(known.begin(), known.end(), given) == known.end()) {
    throw plumbline::InputError("found an unknown command \"" + given + "\", expected a command" +
                                plumbline::nearest_names(given, known));
  }
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
    plumbline::cli::add_validate(app, outcome);
    plumbline::cli::add_tune(app, outcome);
    plumbline::cli::add_compare(app, outcome);
    plumbline::cli::add_fit(app, outcome);
    plumbline::cli::add_diagnose(app, outcome);
    plumbline::cli::add_add(app, outcome);
    plumbline::cli::add_ladder(app, outcome);
    plumbline::cli::add_report(app, command_words(argc, argv));
    plumbline::cli::add_suggest(app, outcome);
    plumbline::cli::add_new_trial(app, outcome);
    plumbline::cli::add_new_model(app, outcome);
    plumbline::cli::add_export(app, outcome);
    plumbline::cli::add_twin(app, outcome);
    plumbline::cli::add_render(app, outcome);
    plumbline::cli::add_spring_mass(app, outcome);
    plumbline::cli::add_certify(app, outcome);
    plumbline::cli::add_verify(app, outcome);
    plumbline::cli::add_key(app, outcome);
    plumbline::cli::add_robot(app, outcome);
    plumbline::cli::add_gait(app, outcome);
    plumbline::cli::add_step_down(app);
    plumbline::cli::add_running(app, outcome);
    refuse_unknown_command(app, argc, argv);
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
