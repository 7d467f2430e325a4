// The models so far, each held against the same trials.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/api/loading.h"
#include "validation/identify/closed_loop/reference.h"
#include "validation/identify/compare/compare.h"
#include "validation/identify/diagnose/screen.h"
#include "validation/report/whole_trials.h"

namespace plumbline::api {

struct LadderRung {
  std::string file, name;
  std::vector<std::string> lineage;
  bool has_train = false, has_held_out = false;
  validation::Comparison windows;  ///< errors in windows from their own start
  std::vector<validation::WholeTrial> trials;
};

struct Ladder {
  std::vector<LadderRung> rungs;                      ///< in the order of the models
  std::vector<validation::ReferenceValue> published;  ///< errors of others on the same data
};

/// `models`: none: the model of the trials and every model that it stands on; one: it and those that it
/// stands on; several: these, in this order.
Ladder ladder(const Sources& sources, const std::vector<std::string>& models,
              const validation::StopFlag* stop, const validation::Progress& progress);

/// docs/formats/json-results.md, `ladder`.
nlohmann::json to_json(const Ladder& ladder);

}  // namespace plumbline::api
