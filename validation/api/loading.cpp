#include "validation/api/loading.h"

#include <filesystem>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"
#include "simulator/trace/error.h"
#include "validation/identify/inverse_model/inverse_model.h"
#include "validation/identify/predict/kept_results.h"
#include "validation/report/repeat_json.h"

namespace plumbline::api {

effects::Catalogue catalogue_without(const std::vector<std::string>& names) {
  effects::Catalogue catalogue = model::known_effects();
  for (const std::string& name : names) {
    if (!catalogue.find(name)) {
      std::vector<std::string> known;
      for (const auto& law : catalogue.laws()) {
        known.push_back(law->declaration().name);
      }
      throw InputError("--without: unknown effect '" + name + "'" + nearest_names(name, known));
    }
    catalogue = catalogue.without(name);
  }
  return catalogue;
}

Loaded load(const model::Model& model, std::vector<validation::Trial> trials, double window,
            const validation::StopFlag* stop) {
  Loaded loaded{model, nullptr};
  for (const validation::Trial& trial : trials) {
    validation::check_command_units(loaded.model, trial);
  }
  validation::check_roles(trials);
  validation::PredictOptions predict;
  predict.window = window;
  loaded.data = std::make_unique<validation::Data>(std::move(trials), predict);
  loaded.data->stop = stop;
  return loaded;
}

Loaded load(const Sources& sources, const validation::StopFlag* stop) {
  const std::string file =
      sources.model.empty() ? validation::model_of_trial(sources.trials.front()) : sources.model;
  const model::Model model = model::read_model(file, model::known_effects());
  validation::TrialOptions options;
  options.data_folder = sources.data_folder;
  std::vector<validation::Trial> trials;
  for (const std::string& path : sources.trials) {
    trials.push_back(validation::read_trial(path, model, options));
  }
  Loaded loaded = load(model, std::move(trials), sources.window, stop);
  if (sources.most_windows > 0) {
    loaded.data->limit(sources.most_windows);
  }
  return loaded;
}

std::vector<std::string> files_of(const Loaded& loaded) {
  std::vector<std::string> files = loaded.model.lineage;
  files.push_back(loaded.model.skeleton.file);
  for (const auto* trials : {&loaded.data->trials, &loaded.data->tests}) {
    for (const validation::Trial& trial : *trials) {
      files.push_back(trial.file);
      files.push_back(trial.data_file);
    }
  }
  return files;
}

std::size_t keep_results(const Loaded& loaded, const std::string& file, work::Workers* workers) {
  using validation::KeptResults;
  const std::string inputs = validation::inputs_hash(loaded.model, loaded.data->trials);
  const auto open = [&](KeptResults::Access access) {
    loaded.data->kept = std::make_shared<KeptResults>(file, inputs, access);
  };
  const bool is_shared = workers != nullptr && workers->ranks() > 1;
  if (!is_shared || workers->is_first()) {
    open(KeptResults::Access::append);  // the others read when it is whole
  }
  if (is_shared) {
    const std::string folder = std::filesystem::path(file).parent_path().string();
    workers->check_shared(folder.empty() ? "." : folder);
    if (!workers->is_first()) {
      open(KeptResults::Access::read);
    }
  }
  return loaded.data->kept->found();
}

void share_work(const Loaded& loaded, work::Workers& workers) {
  if (workers.ranks() == 1) {
    return;
  }
  workers.check_same("set of input files", validation::inputs_hash(loaded.model, loaded.data->trials));
  if (!loaded.data->kept) {
    loaded.data->kept = std::make_shared<validation::KeptResults>();
  }
  loaded.data->kept->share_with(&workers);
}

}  // namespace plumbline::api
