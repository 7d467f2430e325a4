#include "validation/identify/diagnose/rates.h"

#include <cmath>
#include <random>

#include "simulator/model/plant.h"

namespace plumbline::validation {

Eigen::VectorXd rates_at_random_states(const model::Model& model) {
  constexpr int kMotions = 40;
  model::Plant plant(model, {});
  const int states = plant.states();
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::VectorXd all(states * kMotions);
  for (int i = 0; i < kMotions; ++i) {
    const double speed = std::pow(10.0, 3.0 * uniform(random) - 2.0);
    Eigen::VectorXd x = Eigen::VectorXd::NullaryExpr(states, [&] { return uniform(random); });
    x.head(plant.positions()) *= 0.3;
    x.segment(plant.positions(), plant.positions()) *= speed;
    const Eigen::VectorXd command =
        Eigen::VectorXd::NullaryExpr(plant.motors(), [&] { return uniform(random); });
    plant.rate(x.data(), command.data(), &all[i * states]);
  }
  return all;
}

}  // namespace plumbline::validation
