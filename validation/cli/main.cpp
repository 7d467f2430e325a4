#include <algorithm>
#include <array>
#include <cstdio>

#include "simulator/trace/error.h"
#include "validation/cli/command_walking.h"
#include "validation/cli/commands.h"
#include "validation/cli/driving_commands.h"
#include "validation/cli/interrupt.h"
#include "validation/cli/ranks.h"

namespace {

/// One line, whatever the message was.
std::string one_line(std::string text) {
  for (char& c : text) {
    c = c == '\n' ? ' ' : c;
  }
  return text;
}

/// One line on standard error. fmt would throw where that is a file on a full disk.
void complain(const std::string& why) { std::fputs(("plumbline: " + one_line(why) + "\n").c_str(), stderr); }

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

constexpr std::array<const char*, 4> kStudies{"gait", "running", "step-down", "spring-mass"};

/// The command line, the program by its own name. A study's name alone, as before version 0.2, still finds
/// it.
std::vector<std::string> command_words(int argc, char** argv) {
  std::vector<std::string> words{"plumbline"};
  words.insert(words.end(), argv + std::min(argc, 1), argv + argc);
  if (words.size() > 1 && std::find(kStudies.begin(), kStudies.end(), words[1]) != kStudies.end()) {
    complain("`" + words[1] + "` is called `study " + words[1] +
             "` now; the old name goes with the next version");
    words.insert(words.begin() + 1, "study");
  }
  return words;
}

/// CLI11 says only that a command is required when the one given is unknown.
void refuse_unknown_command(const CLI::App& app, const std::vector<std::string>& words) {
  if (words.size() < 2 || words[1].rfind('-', 0) == 0) {
    return;
  }
  const bool is_study = words[1] == "study" && words.size() > 2 && words[2].rfind('-', 0) != 0;
  const std::string& given = words[is_study ? 2 : 1];
  const std::vector<std::string> known = command_names(is_study ? *app.get_subcommand("study") : app);
  if (std::find(known.begin(), known.end(), given) == known.end()) {
    throw plumbline::InputError(std::string("found an unknown ") + (is_study ? "study" : "command") + " \"" +
                                given + "\", expected a " + (is_study ? "study" : "command") +
                                plumbline::nearest_names(given, known));
  }
}

/// Puts the commands that are in no group yet into this one.
void name_group(CLI::App& app, const std::string& name) {
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) {
    if (command->get_group() == "Subcommands") {
      command->group(name);
    }
  }
}

/// In the order of their use, which is the order of the help.
void add_commands(CLI::App& app, const std::vector<std::string>& words, plumbline::cli::Outcome& outcome) {
  plumbline::cli::add_check(app, outcome);
  plumbline::cli::add_new_model(app, outcome);
  plumbline::cli::add_new_trial(app, outcome);
  plumbline::cli::add_compare(app, outcome);
  plumbline::cli::add_diagnose(app, outcome);
  plumbline::cli::add_batch(app, outcome);
  plumbline::cli::add_effects(app, outcome);
  plumbline::cli::add_add(app, outcome);
  plumbline::cli::add_fit(app, outcome);
  plumbline::cli::add_ladder(app, outcome);
  plumbline::cli::add_report(app, words);
  plumbline::cli::add_export(app, outcome);
  plumbline::cli::add_suggest(app, outcome);
  plumbline::cli::add_twin(app, outcome);
  plumbline::cli::add_simulate(app, outcome);
  plumbline::cli::add_render(app, outcome);
  name_group(app, "A model and its measurements");
  plumbline::cli::add_validate(app, outcome);
  plumbline::cli::add_tune(app, outcome);
  plumbline::cli::add_certify(app, outcome);
  plumbline::cli::add_key(app, outcome);
  plumbline::cli::add_verify(app, outcome);
  plumbline::cli::add_robot(app, outcome);
  name_group(app, "A controller, from the published gait to the robot");
  CLI::App* study =
      app.add_subcommand("study", "What single papers did: a gait's design, steps down, spring-mass running");
  study->require_subcommand(1);
  plumbline::cli::add_gait(*study, outcome);
  plumbline::cli::add_step_down(*study);
  plumbline::cli::add_running(*study, outcome);
  plumbline::cli::add_spring_mass(*study, outcome);
  name_group(app, "Studies of single papers");
}

/// CLI11 takes the words from the last to the first, without the program's name.
void parse(CLI::App& app, const std::vector<std::string>& words) {
  app.name(words.front());
  app.parse(std::vector<std::string>(words.rbegin(), words.rend() - 1));
}

/// Other ranks than the first are silent: they leave their reasons to it.
int ended(int status, const std::string& why) {
  complain(why);
  plumbline::cli::workers().fail(one_line(why));
  return status;
}

int run_command(const std::vector<std::string>& words) {
  plumbline::cli::Outcome outcome;
  CLI::App app{"plumbline: hold a robot's model against its measurements and learn which physics is missing"};
  app.require_subcommand(1);
  app.set_version_flag("--version", plumbline::cli::version_text());
  try {
    add_commands(app, words, outcome);
    refuse_unknown_command(app, words);
    parse(app, words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      return app.exit(error);  // --help, --version
    }
    return ended(2, error.what());
  } catch (const plumbline::InputError& error) {
    return ended(2, error.what());
  } catch (const plumbline::work::Refused& error) {
    return ended(2, error.what());
  } catch (const plumbline::validation::Stopped& stopped) {
    return ended(130, stopped.what());
  } catch (const std::exception& error) {
    return ended(1, error.what());
  }
  return outcome.status;
}

}  // namespace

int main(int argc, char** argv) {
  plumbline::cli::catch_interrupts();
  int status = 2;
  try {
    plumbline::cli::start_ranks();
    const std::vector<std::string> words = command_words(argc, argv);
    status = plumbline::cli::is_left_out(words) ? 0 : run_command(words);
  } catch (const plumbline::work::Refused& error) {
    complain(error.what());
  }
  // What was printed may have been meant for a file, and that disk be full.
  if ((std::fflush(stdout) != 0 || std::ferror(stdout) != 0) && status == 0) {
    complain("found no room for what was to be printed, expected a standard output that can be written");
    status = 1;
  }
  return plumbline::cli::workers().finish(status);
}
