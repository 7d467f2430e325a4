#include "validation/compare/rung_name.h"

#include <filesystem>

namespace plumbline::validation {

EffectNames effect_names(const model::Model& model) {
  EffectNames names{""};  // never empty, so that a bare model counts as known
  for (const model::EffectUse& use : model.effects) {
    names.insert(use.law->declaration().name + "@" + use.at);
  }
  return names;
}

std::string rung_name(const model::Model& model, const EffectNames& known) {
  std::string name = std::filesystem::path(model.file).filename().string();
  for (const model::EffectUse& use : model.effects) {
    const std::string label = use.law->declaration().name + "@" + use.at;
    if (!known.empty() && known.count(label) == 0) {
      name += " + " + label;
    }
  }
  return name;
}

}  // namespace plumbline::validation
