#include "validation/diagnose/same_force.h"

#include <cmath>
#include <optional>
#include <random>

#include "simulator/model/plant.h"
#include "validation/diagnose/candidates.h"

namespace plumbline::validation {
namespace {

constexpr int kMotions = 40;

/// Rates at states whose velocities reach over six decades, so that what happens close to rest counts, too.
/// Empty when the states are others than those of the model without the effect.
std::optional<Eigen::VectorXd> rates(const model::Model& model, int states) {
  model::Plant plant(model, {});
  if (plant.states() != states) {
    return std::nullopt;
  }
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

/// By how much an effect with one value changes them; empty where that cannot be said.
std::optional<Eigen::VectorXd> change(const model::Model& model, const effects::Catalogue& catalogue,
                                      const Named& name) {
  const std::shared_ptr<const effects::Law> law = catalogue.find(name.effect);
  if (law == nullptr) {
    return std::nullopt;
  }
  int values = 0;
  for (const effects::Parameter& parameter : law->declaration().parameters) {
    values += parameter.structural ? 0 : 1;
  }
  if (values != 1) {
    return std::nullopt;
  }
  model::Model with = model;
  with.effects.push_back(make_use({law, {}, name.at, {}, {}}, law->typical({})));
  const int states = model::Plant(model, {}).states();
  const std::optional<Eigen::VectorXd> without = rates(model, states);
  std::optional<Eigen::VectorXd> moved = rates(with, states);
  if (moved) {
    *moved -= *without;
  }
  return moved;
}

bool is_multiple(const Eigen::VectorXd& one, const Eigen::VectorXd& other) {
  constexpr double kRounding = 1e-9;
  const double sizes = one.norm() * other.norm();
  return sizes > 0.0 && std::abs(one.dot(other)) > (1.0 - kRounding) * sizes;
}

}  // namespace

void mark_same_forces(const model::Model& model, const effects::Catalogue& catalogue,
                      std::vector<Finding>& findings) {
  for (Finding& finding : findings) {
    if (finding.rivals.empty()) {
      continue;
    }
    const std::optional<Eigen::VectorXd> own = change(model, catalogue, finding);
    for (Rival& rival : finding.rivals) {
      if (own && !rival.same) {
        const std::optional<Eigen::VectorXd> other = change(model, catalogue, rival.name);
        rival.same = other && is_multiple(*own, *other);
      }
    }
  }
}

}  // namespace plumbline::validation
