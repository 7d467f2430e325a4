// The list of all effects that the program knows: explicit, in one place.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "simulator/effects/law.h"

namespace plumbline::effects {

class Catalogue {
 public:
  /// All laws of the project, in the order of the documentation table.
  static Catalogue all();

  explicit Catalogue(std::vector<std::shared_ptr<const Law>> laws) : laws_(std::move(laws)) {}

  const std::vector<std::shared_ptr<const Law>>& laws() const { return laws_; }
  /// nullptr when the name is unknown.
  std::shared_ptr<const Law> find(const std::string& name) const;
  /// A copy without the named effect.
  Catalogue without(const std::string& name) const;

 private:
  std::vector<std::shared_ptr<const Law>> laws_;
};

}  // namespace plumbline::effects
