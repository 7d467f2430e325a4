// `plumbline export`: an identified model back in the format that other simulators read.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "simulator/model/skeleton_export.h"

namespace plumbline::api {

/// Reads the model file and writes its corrected skeleton (model::export_skeleton). Throws InputError when
/// the model cannot be read, the plant cannot be built, or `file` is one that the model was read from.
model::SkeletonExport export_model(const std::string& model_file, const std::string& file);

/// docs/formats/json.md, `export`.
nlohmann::json to_json(const model::SkeletonExport& made, const std::string& model_file,
                       const std::string& file);

}  // namespace plumbline::api
