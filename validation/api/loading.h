// Models and trials, read and checked: where every piece of work begins.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/effects/catalogue.h"
#include "simulator/model/model.h"
#include "validation/identify/predict/problem.h"
#include "work/workers.h"

namespace plumbline::api {

/// What the files are.
struct Sources {
  std::vector<std::string> trials;  ///< folders, or their trial.yaml
  std::string model;                ///< empty: the model that the first trial names
  std::string data_folder;          ///< replaces the trials' data folders; empty: as they say
  double window = 0.5;              ///< length of the prediction windows, s
  std::size_t most_windows = 0;     ///< of each role, spread evenly over its trials; 0: all there are
};

struct Loaded {
  model::Model model;
  std::unique_ptr<validation::Data> data;
};

/// The catalogue less some effects. Throws InputError with the nearest names when one is unknown.
effects::Catalogue catalogue_without(const std::vector<std::string>& names);

/// Reads the model and the trials, checks roles and whether the commands' units can be right, and cuts
/// windows. Long work on the data ends cleanly when `stop` is raised.
Loaded load(const Sources& sources, const validation::StopFlag* stop);

/// The same of trials that are at hand.
Loaded load(const model::Model& model, std::vector<validation::Trial> trials, double window,
            const validation::StopFlag* stop);

/// The files behind them: the model with those that it stands on, its skeleton, the trials and their data.
std::vector<std::string> files_of(const Loaded& loaded);

/// Long work then keeps its results in `file` and goes on from those in it (predict/kept_results.h); how many
/// were found. Throws InputError when the file holds the results of other inputs.
/// Of several ranks the first one writes it, and all must see it.
std::size_t keep_results(const Loaded& loaded, const std::string& file, work::Workers* workers = nullptr);

/// A diagnosis of these data is shared among the workers' ranks. All of them must have read the same files.
void share_work(const Loaded& loaded, work::Workers& workers);

/// A score of trials that are not there is null.
template <typename Json>
Json score_or_null(const Loaded& loaded, validation::Role role, double score) {
  return loaded.data->has(role) ? Json(score) : Json();
}

}  // namespace plumbline::api
