// Slopes of what a Plant's feet and links meet.
#include <utility>

#include "simulator/model/plant_tangent.h"

namespace plumbline::model {
namespace {

constexpr double kBaseStep = 1e-6;  // 1/m or m

}  // namespace

// Adds the slopes of the forces to slopes_, those of bristles' rates to A.
// A writable view is passed by value.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
void PlantTangent::link_tangent(const LinkContacts& links, const double* x, const double* change,
                                Eigen::Ref<Eigen::MatrixXd> A) {
  Eigen::VectorXd dq = Eigen::VectorXd::Zero(n_tree_);
  Eigen::VectorXd dv = dq;
  if (change != nullptr) {
    dq = S_tree_ * Eigen::Map<const Eigen::VectorXd>(change, nz_);
    dv = S_tree_ * Eigen::Map<const Eigen::VectorXd>(change + nz_, nz_);
  }
  LinkSlopes by;
  links.find_slopes(bodies_.tree(), x, nx_, plant_.on_ground(), dq, dv, by);
  const int first = links.first_state();
  const int count = links.states();
  slopes_.leftCols(nz_) += S_tree_.transpose() * by.force_by_q * S_tree_;
  slopes_.middleCols(nz_, nz_) += S_tree_.transpose() * by.force_by_v * S_tree_;
  slopes_.middleCols(first, count) += S_tree_.transpose() * by.force_by_s;
  A.block(first, 0, count, nz_) += by.rate_by_q * S_tree_;
  A.block(first, nz_, count, nz_) += by.rate_by_v * S_tree_;
  A.block(first, first, count, count) += by.rate_by_s;
}

// The links are where rate() has left them. Adds to the column.
void PlantTangent::link_parameter_tangent(const double* x, ParameterId id, double step, effects::Values moved,
                                          Eigen::Ref<Eigen::VectorXd> column) {
  effects::Values& stored = plant_.stored(id.effect);
  Eigen::VectorXd now = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd up = now;
  Eigen::VectorXd before = Eigen::VectorXd::Zero(nz_);
  Eigen::VectorXd after = before;
  plant_.add_links(x, before, now.data());
  std::swap(stored, moved);
  plant_.change_ground();
  plant_.add_links(x, after, up.data());
  std::swap(stored, moved);
  plant_.change_ground();
  column += (up - now) / step;
  column.segment(nz_, nz_) += bodies_.accelerated((after - before) / step);
}

// The foot is where rate() has left it. Adds to the column.
void PlantTangent::ground_parameter_tangent(const FootSlot& slot, const double* x, ParameterId id,
                                            double step, effects::Values moved,
                                            Eigen::Ref<Eigen::VectorXd> column) {
  GroundFeet& feet = plant_.feet();
  effects::Values& stored = plant_.stored(id.effect);
  Eigen::VectorXd now = Eigen::VectorXd::Zero(nx_);
  Eigen::VectorXd up = now;
  Touch before = feet.touch(slot, bodies_.tree());
  feet.press(slot, x, plant_.on_ground(), before, now.data());
  std::swap(stored, moved);
  plant_.change_ground();
  Touch after = feet.touch(slot, bodies_.tree());
  feet.press(slot, x, plant_.on_ground(), after, up.data());
  std::swap(stored, moved);
  plant_.change_ground();
  column += (up - now) / step;
  column.segment(nz_, nz_) += bodies_.accelerated(feet.jacobian(slot, before, bodies_.tree()).transpose() *
                                                  ((after.force - before.force) / step));
  if (!slot.turns.empty()) {
    column.segment(nz_, nz_) += bodies_.accelerated(feet.turn_jacobian(slot, bodies_.tree()).transpose() *
                                                    ((after.moment - before.moment) / step));
  }
}

// By what raises the ground, and by what carries the foot elsewhere.
Eigen::RowVectorXd PlantTangent::depth_slope(int foot, const double* x,
                                             const std::vector<ParameterId>& parameters) {
  Eigen::RowVectorXd slope = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(parameters.size()));
  const FootSlot* slot = plant_.feet().slot_of(foot);
  for (std::size_t p = 0; slot != nullptr && p < parameters.size(); ++p) {
    double& here = slope[static_cast<Eigen::Index>(p)];
    for (const FootSlot::Change& use : slot->changes) {
      if (use.effect == parameters[p].effect) {
        effects::Values unit(plant_.stored(use.effect).size(), 0.0);
        const double before = use.law->change(unit.data()).height;
        unit[static_cast<std::size_t>(parameters[p].parameter)] = 1.0;
        here = use.law->change(unit.data()).height - before;
      }
    }
    if (bodies_.sits_at_base(parameters[p].effect)) {
      const double before = plant_.foot_depth(foot, x).depth;
      BodyVariant& variant = variant_of(parameters[p], kBaseStep);
      bodies_.swap(variant.structure);
      here = (plant_.foot_depth(foot, x).depth - before) / variant.step;
      bodies_.swap(variant.structure);
    }
  }
  return slope;
}

}  // namespace plumbline::model
