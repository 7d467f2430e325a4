// Numbers that JSON does not have.
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>

namespace plumbline::validation {

/// The number; the texts "inf" and "-inf" where it is infinite.
inline nlohmann::json json_number(double value) {
  if (std::isinf(value)) {
    return value > 0.0 ? "inf" : "-inf";
  }
  return value;
}

}  // namespace plumbline::validation
