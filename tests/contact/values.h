// Parameter values by name, so that tests do not know the order.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::contact {

/// Null (standard) values with those given replaced.
inline effects::Values values_of(const effects::Law& law,
                                 const std::vector<std::pair<std::string, double>>& given) {
  effects::Values values = law.null_values();
  for (const auto& [name, value] : given) {
    const int index = law.parameter_index(name);
    if (index < 0) throw std::invalid_argument("no parameter " + name);
    values[static_cast<std::size_t>(index)] = value;
  }
  return values;
}

}  // namespace plumbline::contact
