// Numbers of robot files: a map with value, unit, and source or assumed, and perhaps an uncertainty.
#pragma once

#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"

namespace plumbline::model {

/// What a number must be.
struct QuantityRule {
  std::string unit;  ///< any unit of this one's dimension is taken
  enum class Sign { any, not_zero, not_negative, positive } sign = Sign::any;
  bool infinity = false;                ///< .inf and -.inf are taken
  std::vector<std::string> extra_keys;  ///< keys that the caller reads itself
};

/// Reads and checks; the result is in SI. Throws InputError with the line and key.
Quantity read_quantity(const YamlNode& node, const QuantityRule& rule);

/// `5 %` of the value, or a number times `si_factor`; not negative. Returns one standard deviation in SI.
double read_uncertainty(const YamlNode& node, double value, double si_factor);

/// The texts of `source` or `assumed` (exactly one of them), and which one it is.
struct Origin {
  std::string text;
  bool assumed = false;
};
Origin read_origin(const YamlNode& node);

}  // namespace plumbline::model
