#include "simulator/model/known_effects.h"

#include "contact/laws.h"

namespace plumbline::model {

effects::Catalogue known_effects() {
  auto laws = effects::Catalogue::all().laws();
  const auto ground = contact::ground_laws();
  laws.insert(laws.end(), ground.begin(), ground.end());
  return effects::Catalogue(std::move(laws));
}

}  // namespace plumbline::model
