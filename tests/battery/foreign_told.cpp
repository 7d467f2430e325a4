#include "tests/battery/foreign_told.h"

#include <algorithm>
#include <utility>

#include "simulator/effects/parameters.h"

namespace plumbline::battery {
namespace {

using effects::Parameter;
using effects::Place;
using effects::Values;

/// Of none of the kinds that a simulator knows.
class Told final : public effects::Law {
 public:
  explicit Told(effects::Declaration declaration) : declaration_(std::move(declaration)) {}
  const effects::Declaration& declaration() const override { return declaration_; }
  Values typical(const effects::Scales& /*scales*/) const override { return null_values(); }
  std::vector<Values> starts(const effects::Scales& /*scales*/) const override { return {null_values()}; }

 private:
  effects::Declaration declaration_;
};

std::shared_ptr<const effects::Law> tell(const std::string& name, const std::string& summary,
                                         const std::string& equation, Place place,
                                         std::vector<Parameter> parameters) {
  return std::make_shared<const Told>(
      effects::Declaration{name, summary, equation, "test only", {place}, std::move(parameters), {}, ""});
}

Parameter constant(const std::string& name, const std::string& unit, double standard) {
  return effects::fixed(name, unit, name, standard, -1e3, 1e3);
}

}  // namespace

std::vector<std::shared_ptr<const effects::Law>> told_laws() {
  return {
      tell("creeping_load", "a load that gravity and the turning let creep outwards along a link",
           "a point mass at r; r_rate = mobility*(g*cos(x) + r*v^2), r = from at first", Place::coordinate,
           {effects::any("mass", "kg", "of the load"), constant("from", "m", 0.1),
            constant("mobility", "s", 1e-3)}),
      tell("tilting_mount", "a base that tilts more and more", "pitch = rate*t", Place::world,
           {effects::any("rate", "rad/s", "of tilting")}),
      tell("held_reading", "a reading that is held for two samples now and then",
           "with chance `share`, a sample and the next one show the reading before", Place::sensor,
           {effects::any("share", "1", "chance that a hold begins at a sample")}),
      tell("heavy_bit", "an encoder one of whose bits weighs too much",
           "reading = actual + error where floor(actual/step) is odd", Place::sensor,
           {effects::any("error", "rad", "what the bit weighs too much"), constant("step", "rad", 0.1)}),
      tell("slow_reversal", "an amplifier that needs time to turn its torque round",
           "torque = |u|*s; s_rate = (sgn(u) - s)/time", Place::motor,
           {effects::any("time", "s", "in which it turns round")}),
      tell("weakening_ends", "a motor whose field is weaker away from the middle of its way",
           "torque = u*(1 - loss*((x - centre)/reach)^2)", Place::motor,
           {effects::any("loss", "1", "share of the torque that is lost at the reach"),
            constant("centre", "rad", 0.0), constant("reach", "rad", 50.0)}),
  };
}

bool is_told(const std::string& effect) {
  static const auto laws = told_laws();
  return std::any_of(laws.begin(), laws.end(),
                     [&](const auto& law) { return law->declaration().name == effect; });
}

}  // namespace plumbline::battery
