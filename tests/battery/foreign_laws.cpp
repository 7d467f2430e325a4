#include "tests/battery/foreign_laws.h"

#include <algorithm>
#include <cmath>

#include "simulator/effects/parameters.h"
#include "simulator/model/known_effects.h"
#include "tests/battery/foreign_formulas.h"

namespace plumbline::battery {
namespace {

using effects::Declaration;
using effects::Motion;
using effects::Place;
using effects::Values;

/// What these laws share: no search ever begins at them.
class ForeignLaw : public effects::ForceLaw {
 public:
  explicit ForeignLaw(Declaration declaration) : declaration_(std::move(declaration)) {}
  const Declaration& declaration() const override { return declaration_; }
  Values typical(const effects::Scales& /*scales*/) const override { return null_values(); }
  std::vector<Values> starts(const effects::Scales& /*scales*/) const override { return {null_values()}; }

 private:
  Declaration declaration_;
};

class FadingGround final : public ForeignLaw {
 public:
  FadingGround()
      : ForeignLaw({"fading_ground",
                    "a ground that gets softer over the trial",
                    "f = -share*min(age/time, 1)*stiffness*max(ground - x, 0)^1.5; age_rate = 1",
                    "test only",
                    {Place::coordinate},
                    {effects::any("share", "1", "of the stiffness that is lost in the end"),
                     effects::positive("stiffness", "N/m^1.5", "of the ground at first", 2e6),
                     effects::positive("time", "s", "after which it is lost", 4.0),
                     effects::fixed("ground", "m", "x where the foot touches", 0.4, 0.0, 10.0)},
                    {"age"},
                    ""}) {}
  double force(const Motion& m, const double* state, const double* p) const override {
    return -p[0] * std::min(state[0] / p[2], 1.0) * p[1] * std::pow(std::max(p[3] - m.position, 0.0), 1.5);
  }
  void state_rate(const Motion& /*m*/, const double* /*state*/, const double* /*p*/,
                  double* rate) const override {
    rate[0] = 1.0;
  }
};

class WarmingFriction final : public ForeignLaw {
 public:
  WarmingFriction()
      : ForeignLaw({"warming_friction",
                    "friction that grows with the heat it makes",
                    "f = -level*(1 + heat)*tanh(v/0.003); heat_rate = gain*|v|",
                    "test only",
                    {Place::coordinate},
                    {effects::non_negative("level", "{force}", "friction when cold"),
                     effects::non_negative("gain", "1/{position}", "rise for each metre of way")},
                    {"heat"},
                    ""}) {}
  double force(const Motion& m, const double* state, const double* p) const override {
    return -p[0] * (1.0 + state[0]) * std::tanh(m.velocity / 0.003);
  }
  void state_rate(const Motion& m, const double* /*state*/, const double* p, double* rate) const override {
    rate[0] = p[1] * std::abs(m.velocity);
  }
};

class RailMagnets final : public ForeignLaw {
 public:
  RailMagnets()
      : ForeignLaw({"rail_magnets",
                    "a force that repeats along the way",
                    "f = amplitude*sin(2*pi*x/pitch)",
                    "test only",
                    {Place::coordinate},
                    {effects::any("amplitude", "{force}", "largest force"),
                     effects::fixed("pitch", "{position}", "way after which it repeats", 0.02, 1e-4, 1.0)},
                    {},
                    ""}) {}
  double force(const Motion& m, const double* /*state*/, const double* p) const override {
    return p[0] * std::sin(2.0 * effects::kPi * m.position / p[1]);
  }
};

}  // namespace

std::vector<std::shared_ptr<const effects::Law>> foreign_laws() {
  std::vector<std::shared_ptr<const effects::Law>> laws = foreign_formulas();
  laws.push_back(std::make_shared<const FadingGround>());
  laws.push_back(std::make_shared<const WarmingFriction>());
  laws.push_back(std::make_shared<const RailMagnets>());
  return laws;
}

effects::Catalogue every_law() {
  auto laws = model::known_effects().laws();
  const auto foreign = foreign_laws();
  laws.insert(laws.end(), foreign.begin(), foreign.end());
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
