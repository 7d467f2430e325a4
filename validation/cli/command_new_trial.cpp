#include <fmt/core.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/identify/trial/trial_from_log.h"
#include "validation/identify/trial/write_trial.h"

namespace plumbline::cli {
namespace {

using validation::ColumnLook;
using validation::ColumnRole;
using validation::LogLook;

struct Options {
  std::string folder, log, model, json;
  std::vector<std::string> topics;
};

nlohmann::json to_json(const LogLook& look, const std::string& folder) {
  nlohmann::json columns = nlohmann::json::array();
  for (const ColumnLook& column : look.columns) {
    columns.push_back({{"name", column.name},
                       {"unit", column.unit},
                       {"unit_is_guess", column.unit_is_guess},
                       {"lowest", column.lowest},
                       {"highest", column.highest},
                       {"step", column.step},
                       {"missing", column.missing},
                       {"role", to_string(column.role)},
                       {"why", column.why}});
  }
  return {{"folder", folder},
          {"files", {"trial.yaml"}},
          {"log", look.file},
          {"rows", look.rows},
          {"duration", look.duration},
          {"median_step", look.median_step},
          {"shortest_step", look.shortest_step},
          {"longest_step", look.longest_step},
          {"gaps", look.gaps},
          {"columns", columns},
          {"remarks", look.remarks}};
}

void print(const LogLook& look, const std::string& folder) {
  fmt::print("{}: {} rows", look.file, look.rows);
  if (look.time >= 0) {
    fmt::print(", {:.4g} s in steps of {:.4g} to {:.4g} ms (median {:.4g} ms), {} gaps", look.duration,
               1e3 * look.shortest_step, 1e3 * look.longest_step, 1e3 * look.median_step, look.gaps);
  }
  fmt::print("\n\n");
  std::vector<std::vector<std::string>> rows;
  for (const ColumnLook& column : look.columns) {
    rows.push_back(
        {column.name, column.unit + (column.unit_is_guess ? " ?" : ""), fmt::format("{:.4g}", column.lowest),
         fmt::format("{:.4g}", column.highest), column.step > 0.0 ? fmt::format("{:.3g}", column.step) : "",
         column.missing > 0 ? fmt::format("{}", column.missing) : "", to_string(column.role), column.why});
  }
  print_table({"column", "unit", "from", "to", "step", "missing", "looks like", "because of"}, rows);
  for (const std::string& remark : look.remarks) {
    fmt::print("{}\n", remark);
  }
  fmt::print(
      "\n{}: trial.yaml, whose data stay where the log is. Correct what is guessed, then run `plumbline "
      "check {}`.\n",
      folder, folder);
}

void run(const Options& options) {
  check_writable(options.json);
  if (options.log.empty()) {
    validation::new_trial_template(options.folder);
    write_json({{"folder", options.folder}, {"files", {"trial.yaml", "data.csv", "README.md"}}},
               options.json);
    fmt::print("{}: trial.yaml, data.csv and README.md; fill them in and run `plumbline check {}`\n",
               options.folder, options.folder);
    return;
  }
  std::optional<model::Model> model;
  if (!options.model.empty()) {
    model = model::read_model(options.model, model::known_effects());
  }
  const LogLook look =
      validation::new_trial_from_log(options.folder, options.log, model ? &*model : nullptr, options.topics);
  write_json(to_json(look, options.folder), options.json);
  print(look, options.folder);
}

}  // namespace

void add_new_trial(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "new-trial", "A folder to fill in: trial.yaml explained, or made from what a log looks like");
  command->add_option("folder", options->folder, "the new folder")->required()->type_name("DIR");
  CLI::Option* log = command->add_option(
      "--from", options->log,
      "a log (CSV in any dialect, JSON lines, HDF5, MATLAB, a ROS bag in .mcap or .db3): its columns are "
      "listed and guessed at");
  log->type_name("LOG");
  command
      ->add_option("--model", options->model,
                   "with --from: the robot's model, whose sensors and motors get the columns that fit")
      ->needs(log)
      ->type_name("FILE");
  command
      ->add_option(
          "--topic", options->topics,
          "with --from a bag: the topic whose messages are the rows, and any further ones; left out: "
          "the only one that is likely, and what there is when there are several")
      ->needs(log)
      ->type_name("NAME");
  add_json_option(*command, options->json);
  command->footer(
      "Example:\n  plumbline new-trial trials/steps_on_the_knee\n"
      "  plumbline new-trial trials/swing --from logs/swing.csv --model model.yaml\n"
      "  plumbline new-trial trials/swing --from bag.mcap --topic /joint_states /joint_command");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
