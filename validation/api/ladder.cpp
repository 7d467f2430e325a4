#include "validation/api/ladder.h"

#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "validation/identify/compare/rung_name.h"
#include "validation/report/result_json.h"

namespace plumbline::api {
namespace {

using validation::Role;

std::vector<std::string> model_files(const Sources& sources, const std::vector<std::string>& models) {
  if (models.size() > 1) {
    return models;
  }
  const std::string file =
      models.empty() ? validation::model_of_trial(sources.trials.front()) : models.front();
  return model::read_model(file, model::known_effects()).lineage;
}

LadderRung climb(const Loaded& loaded, const validation::EffectNames& known) {
  LadderRung rung;
  rung.file = loaded.model.file;
  rung.lineage = loaded.model.lineage;
  rung.name = validation::rung_name(loaded.model, known);
  rung.has_train = loaded.data->has(Role::train);
  rung.has_held_out = loaded.data->has(Role::held_out);
  rung.windows = validation::compare(loaded.model, *loaded.data);
  rung.trials = validation::whole_trials(loaded.model, *loaded.data);
  return rung;
}

}  // namespace

Ladder ladder(const Sources& sources, const std::vector<std::string>& models,
              const validation::StopFlag* stop, const validation::Progress& progress) {
  Ladder ladder;
  validation::EffectNames known;
  const std::vector<std::string> files = model_files(sources, models);
  for (std::size_t i = 0; i < files.size(); ++i) {
    progress("ladder: " + std::filesystem::path(files[i]).filename().string(),
             static_cast<double>(i) / static_cast<double>(files.size()));
    Sources rung = sources;
    rung.model = files[i];
    const Loaded loaded = load(rung, stop);
    ladder.rungs.push_back(climb(loaded, known));
    known = validation::effect_names(loaded.model);
  }
  const std::string file = validation::reference_beside(ladder.rungs.front().lineage.front());
  if (!file.empty()) {
    ladder.published = validation::read_reference(file);
  }
  return ladder;
}

nlohmann::json to_json(const Ladder& ladder) {
  nlohmann::json json{{"models", nlohmann::json::array()}, {"published", nlohmann::json::array()}};
  for (const LadderRung& rung : ladder.rungs) {
    nlohmann::json model{{"file", rung.file}, {"name", rung.name}, {"trials", nlohmann::json::array()}};
    model["train"] = rung.has_train ? nlohmann::json(rung.windows.scores.train) : nlohmann::json();
    model["held_out"] = rung.has_held_out ? nlohmann::json(rung.windows.scores.held_out) : nlohmann::json();
    model["test"] =
        rung.windows.scores.test > 0.0 ? nlohmann::json(rung.windows.scores.test) : nlohmann::json();
    model["windows"] = validation::to_json(rung.windows);
    for (const validation::WholeTrial& trial : rung.trials) {
      model["trials"].push_back(validation::to_json(trial));
    }
    json["models"].push_back(model);
  }
  for (const validation::ReferenceValue& value : ladder.published) {
    json["published"].push_back(validation::to_json(value));
  }
  return json;
}

}  // namespace plumbline::api
