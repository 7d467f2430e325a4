#include "contact/ground_change.h"

#include <string>
#include <utility>

#include "simulator/effects/parameters.h"

namespace plumbline::contact {
namespace {

/// One number that the ground is multiplied by, or raised by.
class OneChange final : public GroundChangeLaw {
 public:
  OneChange(effects::Declaration declaration, double GroundChange::*changed)
      : declaration_(std::move(declaration)), changed_(changed) {}
  const effects::Declaration& declaration() const override { return declaration_; }
  GroundChange change(const double* p) const override {
    GroundChange result;
    result.*changed_ = p[0];
    return result;
  }

 private:
  effects::Declaration declaration_;
  double GroundChange::*changed_;
};

std::shared_ptr<const effects::Law> factor_on(const std::string& what, const std::string& of,
                                              double GroundChange::*changed) {
  return std::make_shared<const OneChange>(
      effects::Declaration{
          "ground_" + what + "_error",
          "a ground whose " + what + " differs from the stated one",
          what + " = scale*" + of,
          "relative error of the law that the foot has: ground_normal, ground_friction or ground_coulomb",
          {effects::Place::foot},
          {effects::Parameter{"scale", "1", "true " + what + " over the stated one", 1.0, 0.01, 100.0,
                              effects::Scale::linear, false}},
          {},
          ""},
      changed);
}

}  // namespace

effects::Values GroundChangeLaw::typical(const effects::Scales& scales) const {
  const bool is_length = declaration().parameters.front().unit == "m";
  return {is_length ? effects::guarded(scales).position : 1.0};
}

std::vector<effects::Values> GroundChangeLaw::starts(const effects::Scales& /*scales*/) const {
  return {null_values()};
}

std::shared_ptr<const effects::Law> ground_stiffness_error() {
  return factor_on("stiffness", "stated_stiffness", &GroundChange::stiffness);
}

std::shared_ptr<const effects::Law> ground_damping_error() {
  return factor_on("damping", "stated_damping", &GroundChange::damping);
}

std::shared_ptr<const effects::Law> ground_friction_error() {
  return factor_on("friction", "stated_friction", &GroundChange::friction);
}

std::shared_ptr<const effects::Law> ground_height_error() {
  return std::make_shared<const OneChange>(
      effects::Declaration{"ground_height_error",
                           "a ground that is higher than the terrain says",
                           "depth = stated_depth + height",
                           "error of a length that is measured from the world's origin to the ground",
                           {effects::Place::foot},
                           {effects::any("height", "m", "true height less the stated one; negative: lower")},
                           {},
                           ""},
      &GroundChange::height);
}

}  // namespace plumbline::contact
