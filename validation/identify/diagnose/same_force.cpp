#include "validation/identify/diagnose/same_force.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "validation/identify/diagnose/candidates.h"
#include "validation/identify/diagnose/rates.h"

namespace plumbline::validation {
namespace {

bool has_one_value(const effects::Law& law) {
  const std::vector<effects::Parameter>& parameters = law.declaration().parameters;
  return std::count_if(parameters.begin(), parameters.end(),
                       [](const effects::Parameter& one) { return !one.structural; }) == 1;
}

/// By how much an effect with one value changes the rates `without` it; empty where that cannot be said: for
/// other laws, and those that bring states of their own.
std::optional<Eigen::VectorXd> change(const model::Model& model, const Eigen::VectorXd& without,
                                      const effects::Catalogue& catalogue, const Named& name) {
  const std::shared_ptr<const effects::Law> law = catalogue.find(name.effect);
  if (law == nullptr || !has_one_value(*law)) {
    return std::nullopt;
  }
  model::Model with = model;
  with.effects.push_back(make_use({law, {}, name.at, {}, {}}, law->typical({})));
  Eigen::VectorXd moved = rates_at_random_states(with);
  if (moved.size() != without.size()) {
    return std::nullopt;
  }
  moved -= without;
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
  Eigen::VectorXd without;
  for (Finding& finding : findings) {
    if (finding.rivals.empty()) {
      continue;
    }
    if (without.size() == 0) {
      without = rates_at_random_states(model);
    }
    const std::optional<Eigen::VectorXd> own = change(model, without, catalogue, finding);
    for (Rival& rival : finding.rivals) {
      if (own && !rival.same) {
        const std::optional<Eigen::VectorXd> other = change(model, without, catalogue, rival.name);
        rival.same = other && is_multiple(*own, *other);
      }
    }
  }
}

}  // namespace plumbline::validation
