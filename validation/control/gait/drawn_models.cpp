#include "validation/control/gait/drawn_models.h"

#include <random>

#include "simulator/effects/catalogue.h"

namespace plumbline::validation {
namespace {

void scale_stiffness(model::EffectUse& use, double factor) {
  const auto& parameters = use.law->declaration().parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (parameters[p].name == "stiffness") {
      use.values[p].value *= factor;
    }
  }
}

}  // namespace

model::EffectUse torque_factor(const std::string& motor, double factor) {
  model::Quantity scale;
  scale.value = factor;
  scale.source = "drawn";
  return {effects::Catalogue::all().find("torque_constant_error"), motor, {scale}, 0};
}

std::vector<model::Model> draw_models(const model::Model& model, int count, double share,
                                      std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> factor(1.0 - share, 1.0 + share);
  std::vector<model::Model> drawn(static_cast<std::size_t>(count), model);
  for (model::Model& one : drawn) {
    for (model::Body& body : one.skeleton.bodies) {
      const double f = factor(random);
      body.mass *= f;
      body.inertia *= f;
    }
    for (model::EffectUse& use : one.effects) {
      if (use.law->declaration().name == "cable_stretch") {
        scale_stiffness(use, factor(random));
      }
    }
    for (const model::Motor& motor : one.motors) {
      one.effects.push_back(torque_factor(motor.name, factor(random)));
    }
  }
  return drawn;
}

}  // namespace plumbline::validation
