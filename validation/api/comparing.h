// A comparison with its curves and with errors over the prediction horizon.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "validation/api/loading.h"
#include "validation/compare/compare.h"
#include "validation/compare/horizon.h"

namespace plumbline::api {

struct Compared {
  validation::Comparison comparison;
  std::vector<validation::HorizonError> horizons;
  /// By trial, those of role test behind the others: samples x measured channels, SI; NaN where no window
  /// predicts.
  std::vector<Eigen::MatrixXd> predicted;
};

/// The model as it is: nothing is fitted but the windows' initial states.
Compared compare(const Loaded& loaded);

/// docs/formats/json-results.md, `compare`.
nlohmann::json to_json(const Compared& compared);

}  // namespace plumbline::api
