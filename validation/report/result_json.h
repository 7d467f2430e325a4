// Results as JSON, as the commands write them with --json and as the report carries them (docs/formats.md).
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "validation/identify/compare/compare.h"
#include "validation/identify/compare/horizon.h"
#include "validation/identify/diagnose/diagnose.h"
#include "validation/identify/diagnose/unexplained.h"

namespace plumbline::validation {

nlohmann::json to_json(const Comparison& comparison);
nlohmann::json to_json(const std::vector<HorizonError>& errors);
nlohmann::json to_json(const std::vector<Defect>& defects);
nlohmann::json to_json(const UnexplainedForce& force);
nlohmann::json to_json(const std::vector<LawShare>& laws);
nlohmann::json to_json(const Diagnosis& diagnosis, const std::vector<UnexplainedForce>& left);

}  // namespace plumbline::validation
