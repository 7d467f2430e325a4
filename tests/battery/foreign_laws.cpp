#include "tests/battery/foreign_laws.h"

#include "simulator/model/known_effects.h"
#include "tests/battery/foreign_formulas.h"
#include "tests/battery/foreign_told.h"

namespace plumbline::battery {

effects::Catalogue every_law() {
  auto laws = model::known_effects().laws();
  const auto foreign = foreign_laws();
  laws.insert(laws.end(), foreign.begin(), foreign.end());
  const auto told = told_laws();
  laws.insert(laws.end(), told.begin(), told.end());
  return effects::Catalogue(std::move(laws));
}

model::Model with_foreign_places(model::Model model) {
  if (model.find_coordinate("height") != nullptr && !model.feet.empty()) {
    // What the body's height would be on a leg of unchanged length.
    model.coordinates.push_back({"toe_height", false, {{"rail", 1.0}, {"guide", -1.0}, {"leg", 1.0}}});
  }
  return model;
}

}  // namespace plumbline::battery
