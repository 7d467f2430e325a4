#include "validation/identify/predict/stance.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "contact/contact_law.h"

namespace plumbline::validation {
namespace {

constexpr double kNear = 0.03;  // m: zero errors of a few degrees on a leg of a metre
constexpr double kSlow = 0.25;  // m/s: a foot that lands is several times as fast

struct Standing {
  int foot = 0;
  bool stands = false;  // else it is too deep and moves: to be lifted
};

/// The feet that are to be moved.
std::vector<Standing> standing_feet(model::Plant& plant, const Eigen::VectorXd& x) {
  std::vector<Standing> some;
  for (std::size_t f = 0; f < plant.model().feet.size(); ++f) {
    const auto foot = static_cast<int>(f);
    const model::FootDepth at = plant.foot_depth(foot, x.data());
    if (!std::isfinite(at.depth) || at.depth < -kNear) {
      continue;
    }
    const bool stands = at.depth < kNear && std::abs(at.rate) < kSlow;
    if (stands || at.depth > 0.0) {
      some.push_back({foot, stands});
    }
  }
  return some;
}

const model::EffectUse* normal_law_at(const model::Model& model, const model::Foot& foot) {
  const auto found = std::find_if(model.effects.begin(), model.effects.end(), [&](const auto& use) {
    return foot.answers_to(use.at) && dynamic_cast<const contact::NormalLaw*>(use.law.get()) != nullptr;
  });
  return found == model.effects.end() ? nullptr : &*found;
}

/// The depth between `low` and `high` at which `weight` is carried, by bisection, from below.
template <typename Force>
double depth_that_carries(double weight, double low, double high, const Force& carried_at) {
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    (carried_at(middle) < weight ? low : high) = middle;
  }
  return low;
}

constexpr double kDeepest = 0.1;  // m: no foot rests deeper

/// The depth at which a foot carries `weight`; 0 where it has no law.
double resting_depth(const model::Model& model, const model::Foot& foot, double weight) {
  const model::EffectUse* use = normal_law_at(model, foot);
  if (use == nullptr) {
    return 0.0;
  }
  const auto& law = dynamic_cast<const contact::NormalLaw&>(*use->law);
  const effects::Values p = use->numbers();
  return depth_that_carries(weight, 0.0, kDeepest,
                            [&](double depth) { return law.force(depth, 0.0, p.data()); });
}

double weight_of(const model::Model& model) {
  double mass = 0.0;
  for (const model::Body& body : model.skeleton.bodies) {
    mass += body.mass;
  }
  return mass * model.skeleton.gravity.norm();
}

/// The smallest change in units of the deviations that changes the depths by `wanted`.
Eigen::VectorXd smallest(const Eigen::MatrixXd& J, const Eigen::VectorXd& deviations,
                         const Eigen::VectorXd& wanted) {
  const Eigen::MatrixXd scaled = J * deviations.asDiagonal();
  return deviations.cwiseProduct(scaled.completeOrthogonalDecomposition().solve(wanted));
}

}  // namespace

void stand_on_ground(model::Plant& plant, const Eigen::VectorXd& deviations, Eigen::VectorXd& x) {
  constexpr int kCorrections = 3;  // the depth is not linear in the positions
  const std::vector<Standing> feet = standing_feet(plant, x);
  if (feet.empty()) {
    return;
  }
  const Eigen::Index nz = plant.positions();
  const auto count = static_cast<Eigen::Index>(feet.size());
  const auto standing =
      std::count_if(feet.begin(), feet.end(), [](const Standing& one) { return one.stands; });
  const double share = weight_of(plant.model()) / static_cast<double>(std::max<std::ptrdiff_t>(standing, 1));
  Eigen::MatrixXd J(count, nz);
  for (int correction = 0; correction < kCorrections; ++correction) {
    Eigen::VectorXd wanted = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      const Standing& one = feet[static_cast<std::size_t>(i)];
      const model::FootDepth at = plant.foot_depth(one.foot, x.data());
      J.row(i) = plant.depth_slope(one.foot, x.data());
      const model::Foot& foot = plant.model().feet[static_cast<std::size_t>(one.foot)];
      wanted[i] = (one.stands ? resting_depth(plant.model(), foot, share) : 0.0) - at.depth;
    }
    x.head(nz) += smallest(J, deviations, wanted);
  }
  Eigen::VectorXd rates = Eigen::VectorXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Standing& one = feet[static_cast<std::size_t>(i)];
    J.row(i) = plant.depth_slope(one.foot, x.data());
    rates[i] = one.stands ? -plant.foot_depth(one.foot, x.data()).rate : 0.0;
    if (!one.stands) {
      J.row(i).setZero();
    }
  }
  x.segment(nz, nz) += smallest(J, deviations, rates);
}

std::vector<Eigen::Index> unseen_positions(const Eigen::VectorXd& deviations) {
  constexpr double kNull = 1e-12;  // rad or m: rounding of a row of zeros
  std::vector<Eigen::Index> unseen;
  for (Eigen::Index i = 0; i < deviations.size(); ++i) {
    if (deviations[i] < kNull) {
      unseen.push_back(i);
    }
  }
  return unseen;
}

namespace {

/// What carries each foot where it is, at rest.
Eigen::VectorXd loads_at_rest(model::Plant& plant, const Eigen::VectorXd& x) {
  Eigen::VectorXd still = x;
  still.segment(plant.positions(), plant.positions()).setZero();
  const std::vector<model::Touch> touches = plant.touches(still.data());
  Eigen::VectorXd loads(static_cast<Eigen::Index>(touches.size()));
  for (std::size_t f = 0; f < touches.size(); ++f) {
    loads[static_cast<Eigen::Index>(f)] = touches[f].force.z();
  }
  return loads;
}

double deepest(model::Plant& plant, const Eigen::VectorXd& x) {
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t f = 0; f < plant.model().feet.size(); ++f) {
    most = std::max(most, plant.foot_depth(static_cast<int>(f), x.data()).depth);
  }
  return most;
}

/// How all depths change with the unseen positions, in the mean; as a direction of x's positions.
Eigen::VectorXd way_down(model::Plant& plant, const std::vector<Eigen::Index>& unseen,
                         const Eigen::VectorXd& x) {
  Eigen::VectorXd way = Eigen::VectorXd::Zero(plant.positions());
  for (std::size_t f = 0; f < plant.model().feet.size(); ++f) {
    const Eigen::RowVectorXd slope = plant.depth_slope(static_cast<int>(f), x.data());
    for (const Eigen::Index i : unseen) {
      way[i] += slope[i] / static_cast<double>(plant.model().feet.size());
    }
  }
  return way;
}

void carry_weight(model::Plant& plant, const std::vector<Eigen::Index>& unseen, Eigen::VectorXd& x) {
  constexpr double kNone = 1e-6;
  constexpr double kFirst = 1e-6;  // m
  Eigen::VectorXd way = way_down(plant, unseen, x);
  if (way.squaredNorm() < kNone) {
    return;
  }
  way /= way.squaredNorm();  // a metre of depth
  const Eigen::Index nz = plant.positions();
  x.head(nz) -= deepest(plant, x) * way;
  const double weight = weight_of(plant.model());
  const auto carried_at = [&](double depth) {
    Eigen::VectorXd lower = x;
    lower.head(nz) += depth * way;
    return loads_at_rest(plant, lower).sum();
  };
  double high = kFirst;
  while (high < kDeepest && carried_at(high) < weight) {
    high *= 2.0;
  }
  x.head(nz) += depth_that_carries(weight, 0.0, high, carried_at) * way;
}

/// Velocities of the feet that carry, each times the root of its share; 3 x feet, one behind the other.
Eigen::VectorXd loaded_velocities(model::Plant& plant, const Eigen::VectorXd& shares,
                                  const Eigen::VectorXd& x) {
  const std::vector<model::Touch> touches = plant.touches(x.data());
  Eigen::VectorXd all(3 * shares.size());
  for (std::size_t f = 0; f < touches.size(); ++f) {
    const auto i = static_cast<Eigen::Index>(f);
    all.segment<3>(3 * i) = std::sqrt(shares[i]) * touches[f].velocity;
  }
  return all;
}

void keep_feet_still(model::Plant& plant, const std::vector<Eigen::Index>& unseen, Eigen::VectorXd& x) {
  const Eigen::VectorXd shares = loads_at_rest(plant, x) / weight_of(plant.model());
  const Eigen::Index nz = plant.positions();
  const Eigen::VectorXd slip = loaded_velocities(plant, shares, x);
  Eigen::MatrixXd J(slip.size(), static_cast<Eigen::Index>(unseen.size()));
  for (std::size_t u = 0; u < unseen.size(); ++u) {  // linear in the velocities
    Eigen::VectorXd moved = x;
    moved[nz + unseen[u]] += 1.0;
    J.col(static_cast<Eigen::Index>(u)) = loaded_velocities(plant, shares, moved) - slip;
  }
  const Eigen::VectorXd by = J.completeOrthogonalDecomposition().solve(-slip);
  for (std::size_t u = 0; u < unseen.size(); ++u) {
    x[nz + unseen[u]] += by[static_cast<Eigen::Index>(u)];
  }
}

}  // namespace

void stand_by_unseen(model::Plant& plant, const std::vector<Eigen::Index>& unseen, Eigen::VectorXd& x) {
  carry_weight(plant, unseen, x);
  keep_feet_still(plant, unseen, x);
}

namespace {

/// Where the law's state k comes to rest while the foot slides along either axis: its rate is linear in it.
double bent_by_sliding(const contact::TangentialLaw& law, const effects::Values& p, std::size_t k) {
  constexpr double kSmall = 1e-9;  // m
  double most = 0.0;
  for (const Eigen::Vector2d& slip : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(0.0, 1.0)}) {
    std::vector<double> state(static_cast<std::size_t>(law.state_count()), 0.0);
    std::vector<double> straight = state;
    std::vector<double> bent = state;
    law.state_rate(slip, 1.0, state.data(), p.data(), straight.data());
    state[k] = kSmall;
    law.state_rate(slip, 1.0, state.data(), p.data(), bent.data());
    const double slope = (bent[k] - straight[k]) / kSmall;
    if (slope < 0.0) {
      most = std::max(most, std::abs(straight[k] / slope));
    }
  }
  return most > 0.0 ? most : std::numeric_limits<double>::infinity();
}

}  // namespace

Eigen::VectorXd bent_by_sliding(const model::Plant& plant) {
  const std::vector<std::string> names = plant.state_names();
  Eigen::VectorXd reach = Eigen::VectorXd::Constant(plant.states(), std::numeric_limits<double>::infinity());
  for (const model::EffectUse& use : plant.model().effects) {
    const auto* law = dynamic_cast<const contact::TangentialLaw*>(use.law.get());
    const std::size_t count = law != nullptr ? law->declaration().states.size() : 0;
    for (std::size_t k = 0; k < count; ++k) {
      const std::string name = law->declaration().states[k] + " of " + use.label();  // behind it the foot
      for (std::size_t i = 0; i < names.size(); ++i) {
        if (names[i] == name || names[i].rfind(name + " (", 0) == 0) {
          reach[static_cast<Eigen::Index>(i)] = bent_by_sliding(*law, use.numbers(), k);
        }
      }
    }
  }
  return reach;
}

}  // namespace plumbline::validation
