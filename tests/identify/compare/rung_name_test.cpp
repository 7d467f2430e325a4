// What a rung of the ladder is called.
#include "validation/identify/compare/rung_name.h"

#include <gtest/gtest.h>

#include "simulator/model/known_effects.h"
#include "simulator/model/robot_file.h"

namespace plumbline::validation {
namespace {

/// tests/robots/pendulum with further effects.
model::Model with_effects(const std::vector<std::string>& effects) {
  const effects::Catalogue catalogue = model::known_effects();
  model::Model model = model::read_model(PLUMBLINE_ROOT "/tests/robots/pendulum/model.yaml", catalogue);
  for (const std::string& name : effects) {
    model.effects.push_back({catalogue.find(name), "drive", {}});
  }
  return model;
}

TEST(RungName, SaysWhatIsNewAndHowManyOfMany) {
  const EffectNames known = effect_names(with_effects({}));
  EXPECT_EQ(rung_name(with_effects({}), known), "model.yaml");
  EXPECT_EQ(rung_name(with_effects({"coulomb", "quadratic", "cogging"}), known),
            "model.yaml + coulomb@drive + quadratic@drive + cogging@drive");
  EXPECT_EQ(rung_name(with_effects({"coulomb", "quadratic", "cogging", "stribeck"}), known),
            "model.yaml + coulomb@drive + quadratic@drive and 2 more effects");
}

}  // namespace
}  // namespace plumbline::validation
