#include <fmt/core.h>

#include "validation/api/exporting.h"
#include "validation/cli/commands.h"
#include "validation/cli/files.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::string model, out, json;
};

void print(const model::SkeletonExport& made, const Options& options) {
  fmt::print("{}: {} of {}, with the values of {}\n", options.out, made.format, made.source, options.model);
  if (made.changed.empty()) {
    fmt::print("Nothing in it is another value than in the skeleton.\n");
  } else {
    std::vector<std::vector<std::string>> rows;
    for (const model::ExportedValue& one : made.changed) {
      rows.push_back({one.of, one.what, one.before, one.after, one.unit});
    }
    fmt::print("\n");
    print_table({"of", "value", "before", "now", "unit"}, rows);
  }
  if (!made.left_out.empty()) {
    fmt::print("\n{} does not say, and is not in the file:\n", made.format);
    for (const std::string& sentence : made.left_out) {
      fmt::print("- {}\n", sentence);
    }
  }
}

void run(const Options& options) {
  check_writable(options.out);
  check_writable(options.json);
  check_not_an_input(options.json, {options.model, options.out});
  const model::SkeletonExport made = api::export_model(options.model, options.out);
  write_json(api::to_json(made, options.model, options.out), options.json);
  print(made, options);
}

}  // namespace

void add_export(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "export",
      "The model's skeleton (URDF, SDFormat, MJCF) with the identified values, for other simulators");
  command->add_option("model", options->model, "model file")->required()->type_name("MODEL");
  command
      ->add_option("-o,--out", options->out,
                   "the file to write: the skeleton's own format, or .xml (MJCF) of a .urdf or .sdf")
      ->required()
      ->type_name("FILE");
  add_json_option(*command, options->json);
  command->footer("Example:\n  plumbline export robots/emps/emps.yaml -o emps_identified.sdf");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
