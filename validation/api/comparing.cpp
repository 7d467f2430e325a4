#include "validation/api/comparing.h"

#include "validation/report/result_json.h"

namespace plumbline::api {

Compared compare(const Loaded& loaded) {
  validation::PredictorPool pool(loaded.model, *loaded.data);
  const validation::Estimate estimate = validation::estimate_states(pool);
  Compared compared;
  compared.comparison = validation::compare(loaded.model, *loaded.data, estimate);
  compared.comparison.phases = validation::phase_errors(pool, {}, estimate);
  compared.horizons = validation::horizon_errors(pool, {}, estimate);
  compared.predicted = validation::predicted_traces(pool, {}, estimate);
  return compared;
}

nlohmann::json to_json(const Compared& compared) {
  nlohmann::json json = validation::to_json(compared.comparison);
  json["horizons"] = validation::to_json(compared.horizons);
  return json;
}

}  // namespace plumbline::api
