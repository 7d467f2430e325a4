// The reader of robot files with its skeleton reader as an argument, so that many variants of one model can
// be read without reading the skeleton each time.
#pragma once

#include <functional>
#include <string>

#include "simulator/model/robot_file.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

using SkeletonReader = std::function<Skeleton(const std::string& path)>;

/// As read_model, with another source of skeletons.
Model read_model(const std::string& path, const effects::Catalogue& catalogue,
                 const SkeletonReader& skeletons);

/// Applies one overlay document (effects appended, values replaced).
void apply_overlay(const YamlNode& overlay, const effects::Catalogue& catalogue, Model& model);

}  // namespace plumbline::model
