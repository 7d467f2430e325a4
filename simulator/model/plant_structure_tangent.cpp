// Slopes by what makes up the rigid bodies: masses, inertias, gravity, the ways of the base.
#include <algorithm>

#include "simulator/model/plant_tangent.h"

namespace plumbline::model {
namespace {

bool has_same_mass(const TreeBody& one, const TreeBody& other) {
  return one.mass == other.mass && one.com == other.com && one.inertia == other.inertia;
}

}  // namespace

BodyVariant& PlantTangent::variant_of(ParameterId id, double step) {
  const auto found = std::find_if(variants_.begin(), variants_.end(), [&](const BodyVariant& variant) {
    return variant.id.effect == id.effect && variant.id.parameter == id.parameter;
  });
  if (found != variants_.end()) {
    return *found;
  }
  double& stored = plant_.stored(id.effect)[static_cast<std::size_t>(id.parameter)];
  const double here = stored;
  BodyVariant variant;
  variant.id = id;
  variant.step = step;
  stored = here + step;
  variant.structure = bodies_.make_structure();
  stored = here;
  const std::vector<TreeBody>& bodies = variant.structure.mechanism->tree().bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!has_same_mass(bodies[b], bodies_.tree().bodies()[b])) {
      variant.heavier.push_back(static_cast<int>(b));
    }
  }
  variants_.push_back(std::move(variant));
  return variants_.back();
}

// -M^-1 (dM a + dh), what the same motion needs more; at the x and a that tree_slopes_ was set for.
void PlantTangent::structure_tangent(const double* x, ParameterId id, double step, bool refresh,
                                     Eigen::Ref<Eigen::VectorXd> column) {
  BodyVariant& variant = variant_of(id, step);
  if (variant.structure.mechanism->tree().gravity() != bodies_.tree().gravity()) {
    gravity_tangent(x, variant, refresh, column);
    return;
  }
  bodies_.factor_at(x);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(n_tree_);
  for (const int body : variant.heavier) {
    const TreeBody& other = variant.structure.mechanism->tree().bodies()[static_cast<std::size_t>(body)];
    tree_slopes_.add_other_mass(bodies_.tree(), body, other, force);
  }
  const Eigen::VectorXd more =
      S_tree_.transpose() * force +
      (variant.structure.extra_reduced - bodies_.structure().extra_reduced) * plant_.acceleration();
  column.segment(nz_, nz_) = -bodies_.accelerated(more) / variant.step;
}

void PlantTangent::gravity_tangent(const double* x, BodyVariant& variant, bool refresh,
                                   Eigen::Ref<Eigen::VectorXd> column) {
  if (refresh || variant.dM.size() == 0) {
    Eigen::MatrixXd M;
    Eigen::VectorXd h;
    bodies_.evaluate(x, variant.structure, M, h);
    variant.dM = (M - bodies_.M()) / variant.step;
    variant.dh = (h - bodies_.h()) / variant.step;
  }
  column.segment(nz_, nz_) = -bodies_.accelerated(variant.dM * plant_.acceleration() + variant.dh);
}

// The ways of the base carry the feet: the whole rate changes, not the rigid bodies' part alone.
void PlantTangent::base_tangent(const SampleMotion& sample, ParameterId id, double step,
                                Eigen::Ref<Eigen::VectorXd> column) {
  BodyVariant& variant = variant_of(id, step);
  const auto rate_here = [&]() {
    bodies_.forget();
    Eigen::VectorXd xdot = Eigen::VectorXd::Zero(nx_);
    plant_.rate(sample.middle, sample.command, xdot.data());
    return xdot;
  };
  bodies_.swap(variant.structure);
  const Eigen::VectorXd there = rate_here();
  bodies_.swap(variant.structure);
  column = (there - rate_here()) / variant.step;
}

}  // namespace plumbline::model
