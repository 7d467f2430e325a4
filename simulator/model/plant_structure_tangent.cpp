// Slopes by what makes up the rigid bodies: masses, inertias, gravity, the ways of the base.
#include <algorithm>

#include "simulator/model/plant.h"

namespace plumbline::model {
namespace {

bool has_same_mass(const TreeBody& one, const TreeBody& other) {
  return one.mass == other.mass && one.com == other.com && one.inertia == other.inertia;
}

}  // namespace

Plant::Variant& Plant::variant_of(ParameterId id, double step) {
  const auto found = std::find_if(variants_.begin(), variants_.end(), [&](const Variant& variant) {
    return variant.id.effect == id.effect && variant.id.parameter == id.parameter;
  });
  if (found != variants_.end()) {
    return *found;
  }
  double& stored = values_[static_cast<std::size_t>(id.effect)][static_cast<std::size_t>(id.parameter)];
  const double here = stored;
  Variant variant;
  variant.id = id;
  variant.step = step;
  stored = here + step;
  variant.structure = make_structure();
  stored = here;
  const std::vector<TreeBody>& bodies = variant.structure.mechanism->tree().bodies();
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!has_same_mass(bodies[b], tree().bodies()[b])) {
      variant.heavier.push_back(static_cast<int>(b));
    }
  }
  variants_.push_back(std::move(variant));
  return variants_.back();
}

// -M^-1 (dM a + dh), what the same motion needs more; at the x and a that tree_slopes_ was set for.
void Plant::structure_tangent(const double* x, ParameterId id, double step, bool refresh,
                              Eigen::Ref<Eigen::VectorXd> column) {
  Variant& variant = variant_of(id, step);
  if (variant.structure.mechanism->tree().gravity() != tree().gravity()) {
    gravity_tangent(x, variant, refresh, column);
    return;
  }
  factor_at(x);
  Eigen::VectorXd force = Eigen::VectorXd::Zero(n_tree_);
  for (const int body : variant.heavier) {
    const TreeBody& other = variant.structure.mechanism->tree().bodies()[static_cast<std::size_t>(body)];
    tree_slopes_.add_other_mass(tree(), body, other, force);
  }
  const Eigen::VectorXd more = S_tree_.transpose() * force +
                               (variant.structure.extra_reduced - structure_.extra_reduced) * acceleration_;
  column.segment(nz_, nz_) = -accelerated(more) / variant.step;
}

void Plant::gravity_tangent(const double* x, Variant& variant, bool refresh,
                            Eigen::Ref<Eigen::VectorXd> column) {
  if (refresh || variant.dM.size() == 0) {
    Eigen::MatrixXd M;
    Eigen::VectorXd h;
    evaluate_rigid(x, variant.structure, M, h);
    variant.dM = (M - M_) / variant.step;
    variant.dh = (h - h_) / variant.step;
  }
  column.segment(nz_, nz_) = -accelerated(variant.dM * acceleration_ + variant.dh);
}

bool Plant::sits_at_base(int effect) const {
  return model_.effects[static_cast<std::size_t>(effect)].law->sits_at(effects::Place::base);
}

// The ways of the base carry the feet: the whole rate changes, not the rigid bodies' part alone.
void Plant::base_tangent(const SampleMotion& sample, ParameterId id, double step,
                         Eigen::Ref<Eigen::VectorXd> column) {
  Variant& variant = variant_of(id, step);
  const auto rate_here = [&]() {
    rigid_known_ = false;
    Eigen::VectorXd xdot = Eigen::VectorXd::Zero(nx_);
    rate(sample.middle, sample.command, xdot.data());
    return xdot;
  };
  std::swap(structure_, variant.structure);
  const Eigen::VectorXd there = rate_here();
  std::swap(structure_, variant.structure);
  column = (there - rate_here()) / variant.step;
}

}  // namespace plumbline::model
