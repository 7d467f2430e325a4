#include "validation/api/suggesting.h"

#include <cmath>

namespace plumbline::api {

using validation::Separation;
using validation::Suggestions;

nlohmann::json to_json(const Suggestions& suggestions) {
  nlohmann::json json{{"refused", suggestions.refused},
                      {"explanations", nlohmann::json::array()},
                      {"experiments", nlohmann::json::array()}};
  for (const validation::Explanation& one : suggestions.explanations) {
    json["explanations"].push_back(
        {{"effect", one.name}, {"train", one.scores.train}, {"held_out", one.scores.held_out}});
  }
  for (const Separation& one : suggestions.experiments) {
    json["experiments"].push_back(
        {{"name", one.name},
         {"share_of_reach", one.share},
         {"error", one.error},
         {"seconds", std::isfinite(one.seconds) ? nlohmann::json(one.seconds) : nlohmann::json()}});
  }
  json["inseparable"] = nlohmann::json::array();
  for (const auto& [one, other] : suggestions.inseparable) {
    json["inseparable"].push_back({one, other});
  }
  return json;
}

bool any_separable(const Suggestions& suggestions) {
  return !suggestions.experiments.empty() && suggestions.experiments.front().seconds > 0.0;
}

}  // namespace plumbline::api
