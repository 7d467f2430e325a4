// Points and turns as model files state them.
#pragma once

#include <Eigen/Core>
#include <string>

#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// Three numbers; `expected` says what they are. Throws InputError.
Eigen::Vector3d three(const YamlNode& node, const std::string& expected);

/// SI for each of a unit; one of another dimension than `like` is refused.
double factor_of(const YamlNode& unit, const char* like);

/// `{value: [roll, pitch, yaw], unit: deg}` as in URDF: about x, then the fixed y, then the fixed z.
Eigen::Matrix3d turned(const YamlNode& turn);

}  // namespace plumbline::model
