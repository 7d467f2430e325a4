// Numbers in few bytes, for pages that carry them along.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validation/report/thin.h"

namespace plumbline::validation {

/// RFC 4648, with padding.
std::string base64(const void* bytes, std::size_t count);

/// Little-endian 32-bit floats in base64.
std::string floats(const Eigen::VectorXd& values);

/// Thinned points as 16-bit integers q with value = middle + step q, with a middle and step of its own for
/// each block, so that a block in detail keeps its fine digits; q = -32768 stands for NaN:
///   {"middle": [by block], "step": [by block], "data": base64 of little-endian int16}
/// The error is at most half a step: 1/65534 of the block's range.
nlohmann::json packed(const Eigen::VectorXd& points, const std::vector<Block>& blocks);

}  // namespace plumbline::validation
