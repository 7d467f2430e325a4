// The monopod's constants by the names that the controller's ports give them.
#pragma once

#include <string>
#include <vector>

#include "controllers/monopod/parameters.h"

namespace plumbline::validation {

/// Where a constant of that name sits; nullptr: none has it.
inline double* constant_by_name(monopod::Constants& c, const std::string& name) {
  const auto all = monopod::slots(c);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (name == monopod::kParameters[i].name) {
      return all[i];
    }
  }
  return nullptr;
}

inline std::vector<std::string> constant_names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < monopod::kConstantCount; ++i) {
    names.emplace_back(monopod::kParameters[i].name);
  }
  return names;
}

}  // namespace plumbline::validation
