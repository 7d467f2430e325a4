#include "validation/api/exporting.h"

#include <filesystem>
#include <vector>

#include "simulator/model/known_effects.h"
#include "simulator/model/plant.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"

namespace plumbline::api {
namespace {

namespace fs = std::filesystem;

void refuse_inputs(const model::Model& model, const std::string& file) {
  std::vector<std::string> inputs = model.lineage;
  inputs.push_back(model.skeleton.file);
  std::error_code none;
  for (const std::string& input : inputs) {
    if (fs::equivalent(input, file, none)) {
      throw InputError({file, 0, ""}, "the name of a file that the model is read from", "another name");
    }
  }
}

}  // namespace

model::SkeletonExport export_model(const std::string& model_file, const std::string& file) {
  const model::Model model = model::read_model(model_file, model::known_effects());
  refuse_inputs(model, file);
  const model::Plant plant(model, {});  // refuses what no simulator could move
  return model::export_skeleton(model, file);
}

nlohmann::json to_json(const model::SkeletonExport& made, const std::string& model_file,
                       const std::string& file) {
  nlohmann::json json{{"model", model_file},
                      {"skeleton", made.source},
                      {"file", file},
                      {"format", made.format},
                      {"changed", nlohmann::json::array()},
                      {"left_out", made.left_out}};
  for (const model::ExportedValue& one : made.changed) {
    json["changed"].push_back({{"of", one.of},
                               {"what", one.what},
                               {"before", one.before},
                               {"after", one.after},
                               {"unit", one.unit}});
  }
  return json;
}

}  // namespace plumbline::api
