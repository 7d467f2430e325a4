#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/model/yaml_node.h"
#include "validation/cli/commands.h"
#include "validation/cli/describe.h"
#include "validation/cli/describe_meshes.h"
#include "validation/cli/inputs.h"
#include "validation/cli/output.h"
#include "validation/identify/inverse_model/inverse_model.h"

namespace plumbline::cli {
namespace {

struct Options {
  std::vector<std::string> paths;
  std::string model, data_folder, json;
  double density = 0.0;
};

/// A folder, or a file that calls itself a trial; otherwise it must call itself a model.
bool is_trial(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) {
    return true;
  }
  const model::YamlNode kind = model::YamlNode::load(path).at("plumbline");
  if (kind.text() != "trial/1" && kind.text() != "model/1") {
    kind.refuse("model/1 or trial/1");
  }
  return kind.text() == "trial/1";
}

/// What a file says, for the JSON and for the reader.
struct Checked {
  nlohmann::json json;
  std::function<void()> print;
};

Checked check_model(const std::string& path, const Options& options, const effects::Catalogue& catalogue) {
  const model::Model model = model::read_model(path, catalogue);
  const Freedom freedom = api::freedom_of(model, {});
  const std::vector<MeshOfBody> meshes = meshes_of(model, options.density);
  nlohmann::json json = api::to_json(model, freedom);
  json["meshes"] = to_json(meshes);
  return {json, [=] {
            print(model, freedom);
            print(meshes, options.density);
          }};
}

Checked check_trial(const std::string& path, const Options& options, const effects::Catalogue& catalogue) {
  const std::string file = options.model.empty() ? validation::model_of_trial(path) : options.model;
  const model::Model model = model::read_model(file, catalogue);
  const validation::Trial trial = validation::read_trial(path, model, {options.data_folder});
  const Freedom freedom = api::freedom_of(model, trial.locks);
  validation::check_command_units(model, trial);
  return {api::to_json(trial, model, freedom), [=] { print(trial, model, freedom); }};
}

/// The JSON of several is a list. It is written first: where it cannot be, nothing is printed.
void run(const Options& options) {
  const effects::Catalogue catalogue = model::known_effects();
  nlohmann::json all = nlohmann::json::array();
  std::vector<std::function<void()>> prints;
  for (const std::string& path : options.paths) {
    Checked one =
        is_trial(path) ? check_trial(path, options, catalogue) : check_model(path, options, catalogue);
    all.push_back(std::move(one.json));
    prints.push_back(std::move(one.print));
  }
  write_json(all.size() == 1 ? all.front() : all, options.json);
  for (const auto& print : prints) {
    print();
  }
}

}  // namespace

void add_check(CLI::App& app, Outcome& /*outcome*/) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("check", "Read and validate a model or a trial, and say what it is");
  command->add_option("path", options->paths, "model files, trial folders or trial.yamls")
      ->required()
      ->type_name("MODEL|TRIAL");
  command->add_option("--model", options->model, "for a trial: model file in place of the one it names")
      ->type_name("FILE");
  command->add_option("--data", options->data_folder, "for a trial: folder with its data files")
      ->type_name("DIR");
  command
      ->add_option("--density", options->density,
                   "for a model: of the links' meshes, kg/m^3; left out, the one that gives each its mass")
      ->check(between(1e-3, 1e6))
      ->type_name("DENSITY");
  add_json_option(*command, options->json);
  command->footer("Example:\n  plumbline check robots/mabel/leg_bench.yaml");
  command->callback([options] { run(*options); });
}

}  // namespace plumbline::cli
