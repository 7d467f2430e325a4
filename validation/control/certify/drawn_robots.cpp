#include "validation/control/certify/drawn_robots.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "validation/control/gait/drawn_models.h"

namespace plumbline::validation {
namespace {

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) {}

  /// A factor for a value with this standard deviation; 1 where none is stated.
  double factor(double value, double deviation) {
    if (!(deviation > 0.0) || value == 0.0) {
      return 1.0;
    }
    return std::max(1.0 + within_three() * deviation / std::abs(value), 0.1);
  }

 private:
  double within_three() {
    double number = 0.0;
    do {
      number = normal_(random_);
    } while (std::abs(number) > 3.0);
    return number;
  }

  std::mt19937_64 random_;
  std::normal_distribution<double> normal_{0.0, 1.0};
};

}  // namespace

std::vector<model::Model> draw_robots(const model::Model& model, int count, std::uint64_t seed) {
  Draw draw(seed);
  std::vector<model::Model> drawn(static_cast<std::size_t>(count), model);
  for (model::Model& one : drawn) {
    for (model::Body& body : one.skeleton.bodies) {
      const double f = draw.factor(body.mass, body.mass_uncertainty);
      body.mass *= f;
      body.inertia *= f;
    }
    for (model::EffectUse& use : one.effects) {
      for (model::Quantity& value : use.values) {
        value.value *= draw.factor(value.value, value.uncertainty);
      }
    }
    for (model::Motor& motor : one.motors) {
      motor.rotor_inertia.value *= draw.factor(motor.rotor_inertia.value, motor.rotor_inertia.uncertainty);
      const double f = draw.factor(motor.torque_constant.value, motor.torque_constant.uncertainty);
      if (f != 1.0) {
        one.effects.push_back(torque_factor(motor.name, f));
      }
    }
  }
  return drawn;
}

}  // namespace plumbline::validation
