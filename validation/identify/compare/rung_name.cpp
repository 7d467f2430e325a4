#include "validation/identify/compare/rung_name.h"

#include <fmt/core.h>

#include <filesystem>
#include <vector>

namespace plumbline::validation {
namespace {

/// "coulomb@drive"
std::string name_of(const model::EffectUse& use) { return use.law->declaration().name + "@" + use.at; }

}  // namespace

EffectNames effect_names(const model::Model& model) {
  EffectNames names{""};  // never empty, so that a bare model counts as known
  for (const model::EffectUse& use : model.effects) {
    names.insert(name_of(use));
  }
  return names;
}

std::string rung_name(const model::Model& model, const EffectNames& known) {
  constexpr std::size_t kMost = 3;
  constexpr std::size_t kOfMany = 2;
  std::vector<std::string> added;
  for (const model::EffectUse& use : model.effects) {
    if (!known.empty() && known.count(name_of(use)) == 0) {
      added.push_back(name_of(use));
    }
  }
  const std::size_t shown = added.size() > kMost ? kOfMany : added.size();
  std::string name = std::filesystem::path(model.file).filename().string();
  for (std::size_t i = 0; i < shown; ++i) {
    name += " + " + added[i];
  }
  return shown < added.size() ? fmt::format("{} and {} more effects", name, added.size() - shown) : name;
}

}  // namespace plumbline::validation
