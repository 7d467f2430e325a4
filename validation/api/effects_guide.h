// What a reader of an answer wants to know of an effect beside its equation: what it looks like, and how to
// tell.
#pragma once

#include <string>
#include <vector>

namespace plumbline::api {

/// domain: the part of physics ("friction", "winding and supply", ...); confused_with: other effects that
/// leave much the same errors; experiment: a motion on which they differ.
struct EffectGuide {
  std::string name, domain, confused_with, experiment;
};

/// One for each law that the program knows, in the order of their domains.
const std::vector<EffectGuide>& effects_guide();

/// nullptr where there is none.
const EffectGuide* find_guide(const std::string& effect);

}  // namespace plumbline::api
