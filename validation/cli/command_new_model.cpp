#include <fmt/core.h>

#include "validation/api/new_model.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

struct Options {
  api::NewModelWish wish;
  std::string json;
};

std::string column_text(const std::string& name, bool by_number) {
  return name.empty() ? "none" : name + (by_number ? " (by number)" : "");
}

void print(const api::NewModel& made, bool with_log) {
  const bool currents = made.command_unit == "A";
  std::vector<std::string> head{"joint", "motor"};
  if (with_log) {
    head.insert(head.end(), {"position column", "command column"});
  }
  if (currents) {
    head.insert(head.end(), {"torque constant", "because"});
  }
  std::vector<std::vector<std::string>> rows;
  bool numbered = false;
  for (const api::NewJoint& one : made.joints) {
    rows.push_back({one.joint, one.motor});
    if (with_log) {
      rows.back().push_back(column_text(one.position, one.position_by_number));
      rows.back().push_back(column_text(one.command, one.command_by_number));
    }
    if (currents) {
      rows.back().push_back(fmt::format("{:.4g}", one.torque_constant));
      rows.back().push_back(one.torque_constant_from.substr(0, one.torque_constant_from.find(':')));
    }
    numbered = numbered || one.position_by_number || one.command_by_number;
  }
  print_table(head, rows);
  if (numbered) {
    fmt::print(
        "By number: as many columns as moving joints, taken in the skeleton's order. Look whether it is.\n");
  }
  for (const std::string& column : made.unused) {
    fmt::print("Column {}: belongs to no joint, or stands beside one that was taken.\n", column);
  }
  for (const std::string& remark : made.remarks) {
    fmt::print("{}\n", remark);
  }
  fmt::print("\n{}: correct what is `assumed`, then run `plumbline check {}`.\n", made.file, made.file);
  if (!made.trials.empty()) {
    fmt::print(
        "{} and {}: the first 60 % of the log and the rest. Its data stay where they are. Then\n"
        "`plumbline compare {} {}`.\n",
        made.trials.front(), made.trials.back(), made.trials.front(), made.trials.back());
  }
}

void run(const Options& options) {
  check_writable(options.json);
  check_not_an_input(options.json, {options.wish.skeleton, options.wish.log});
  const api::NewModel made = api::new_model(options.wish);
  write_json(api::to_json(made), options.json);
  print(made, !options.wish.log.empty());
}

}  // namespace

void add_new_model(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "new-model",
      "A model.yaml to correct, from a skeleton, and trials from a log with the joints' columns");
  command->add_option("skeleton", options->wish.skeleton, "a skeleton: .urdf, .sdf or .xml (MJCF)")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--from", options->wish.log,
                   "a log: columns called after the joints become a train and a held-out trial")
      ->type_name("LOG");
  command
      ->add_option("--topic", options->wish.topics,
                   "with --from a bag: the topic whose messages are the rows, and any further ones")
      ->needs("--from")
      ->type_name("NAME");
  command->add_option("-o,--out", options->wish.file, "the model file to write")
      ->required()
      ->type_name("FILE");
  command
      ->add_option("--command-unit", options->wish.command_unit,
                   "what motors are commanded by: A or \"N m\"; left out, what the log states")
      ->check(CLI::IsMember({"A", "N m"}));
  command->add_flag("--floating-base", options->wish.floating_base,
                    "the root link floats: for a URDF or SDFormat file in which no joint leads to it");
  add_json_option(*command, options->json);
  command->footer("Example:\n  plumbline new-model arm.urdf --from swing.csv -o model.yaml --command-unit A");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
