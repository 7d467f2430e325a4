#include <fmt/core.h>

#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/trial/write_trial.h"

namespace plumbline::cli {

void add_new_trial(CLI::App& app, Outcome& /*outcome*/) {
  struct Options {
    std::string folder, json;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("new-trial", "A folder to fill in: trial.yaml explained, data.csv, README.md");
  command->add_option("folder", options->folder, "the new folder")->required()->type_name("DIR");
  add_json_option(*command, options->json);
  command->footer("Example:\n  plumbline new-trial trials/steps_on_the_knee");
  command->callback([options] {
    check_writable(options->json);
    validation::new_trial_template(options->folder);
    write_json({{"folder", options->folder}, {"files", {"trial.yaml", "data.csv", "README.md"}}},
               options->json);
    fmt::print("{}: trial.yaml, data.csv and README.md; fill them in and run `plumbline check {}`\n",
               options->folder, options->folder);
  });
}

}  // namespace plumbline::cli
