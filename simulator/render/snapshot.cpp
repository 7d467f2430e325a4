#include "simulator/render/snapshot.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "simulator/model/body_poses.h"

namespace plumbline::render {
namespace {

using effects::Place;
using model::Model;

/// The joint with the largest share in a coordinate, and that share.
struct MainJoint {
  int joint = -1;
  double factor = 0.0;
};

int joint_index(const model::Skeleton& skeleton, const std::string& name) {
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    if (skeleton.joints[j].name == name && skeleton.joints[j].type != model::JointType::fixed) {
      return static_cast<int>(j);
    }
  }
  return -1;
}

MainJoint main_joint(const Model& model, const std::string& name) {
  MainJoint best;
  if (const model::Coordinate* coordinate = model.find_coordinate(name)) {
    for (const model::Term& term : coordinate->terms) {
      const int joint = joint_index(model.skeleton, term.of);
      if (joint >= 0 && std::abs(term.factor) > std::abs(best.factor)) {
        best = {joint, term.factor};
      }
    }
    return best;
  }
  return {joint_index(model.skeleton, name), 1.0};
}

/// The joint that a spring's place moves; of a pulley, that of the coordinate beside it in its ratio.
MainJoint spring_joint(const Model& model, const std::string& at) {
  if (model.find_pulley(at) == nullptr) {
    return main_joint(model, at);
  }
  for (const model::Ratio& ratio : model.ratios) {
    const bool named =
        std::any_of(ratio.to.begin(), ratio.to.end(), [&](const model::Term& term) { return term.of == at; });
    if (named && ratio.to.front().of != at) {
      return main_joint(model, ratio.to.front().of);
    }
  }
  return {};
}

/// Of a law's parameter; 0 where it has none of this name.
double value_of(const model::EffectUse& use, const std::string& name) {
  const auto& parameters = use.law->declaration().parameters;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (parameters[p].name == name) {
      return use.values[p].value;
    }
  }
  return 0.0;
}

/// Between samples k and k + 1.
struct Between {
  Eigen::Index k;
  double share;
};

Between find(const Eigen::VectorXd& time, double t) {
  const Eigen::Index last = time.size() - 1;
  const Eigen::Index after = std::upper_bound(time.data(), time.data() + time.size(), t) - time.data();
  if (after <= 0 || last == 0) {
    return {0, 0.0};
  }
  if (after > last) {
    return {last - 1, 1.0};
  }
  return {after - 1, (t - time[after - 1]) / (time[after] - time[after - 1])};
}

/// z along the axis, x along the link.
Eigen::Matrix3d frame_of(const Eigen::Vector3d& axis, const Eigen::Vector3d& link) {
  Eigen::Vector3d x = link - link.dot(axis) * axis;
  if (x.norm() < 1e-6) {
    x = axis.unitOrthogonal();
  }
  x.normalize();
  Eigen::Matrix3d R;
  R << x, axis.cross(x), axis;
  return R;
}

}  // namespace

Snapshots::Snapshots(const model::Plant& plant, const Motion& motion)
    : plant_(plant),
      motion_(motion),
      directions_(main_directions(plant.model().skeleton, sticks_of(plant.model()))) {
  find_cables();
  find_springs();
}

// Every ratio that an effect releases: c(q) = motor - ratio * coordinate, so the joint stands c / (ratio *
// factor) short of where a rigid cable would have it.
void Snapshots::find_cables() {
  const Model& model = plant_.model();
  std::set<std::string> seen;
  for (const model::EffectUse& use : model.effects) {
    if (model.resolve(*use.law, use.at) != Place::ratio || use.law->is_null(use.numbers().data())) {
      continue;
    }
    const model::Ratio* ratio = model.find_ratio(use.at);
    if (ratio == nullptr) {
      continue;  // a rod of a loop
    }
    const MainJoint main = main_joint(model, ratio->to.front().of);
    if (main.joint >= 0 && ratio->to.front().factor != 0.0 && seen.insert(ratio->name).second) {
      cables_.push_back({ratio->name, main.joint, -1.0 / (ratio->to.front().factor * main.factor)});
    }
  }
}

void Snapshots::find_springs() {
  const Model& model = plant_.model();
  const std::set<std::string> springs{"spring", "unilateral_spring", "hardening"};
  for (const model::EffectUse& use : model.effects) {
    if (springs.count(use.law->declaration().name) == 0 || use.law->is_null(use.numbers().data()) ||
        model.resolve(*use.law, use.at) != Place::coordinate) {
      continue;
    }
    const MainJoint main = spring_joint(model, use.at);
    if (main.joint >= 0) {
      springs_turn_ = model.place_is_angular(Place::coordinate, use.at);
      springs_.push_back({use.at, model.skeleton.joints[static_cast<std::size_t>(main.joint)].child,
                          value_of(use, "rest"), value_of(use, "side")});
    }
  }
}

double Snapshots::deflection(const Spring& spring, const double* x) const {
  const double beyond = plant_.position_of(spring.at, x) - spring.rest;
  return spring.side == 0.0 ? std::abs(beyond) : std::max(0.0, spring.side * beyond);
}

bool Snapshots::has_springs() const { return !springs_.empty(); }

Eigen::VectorXd Snapshots::state_at(double time) const {
  const auto [k, share] = find(motion_.time, time);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
  const Eigen::Index next = std::min(k + 1, motion_.time.size() - 1);
  x.head(plant_.positions()) = (1.0 - share) * motion_.positions.col(k) + share * motion_.positions.col(next);
  return x;
}

void Snapshots::add_stretches(const double* x, Snapshot& shot) const {
  const model::Skeleton& skeleton = plant_.model().skeleton;
  for (const Cable& cable : cables_) {
    const model::Joint& joint = skeleton.joints[static_cast<std::size_t>(cable.joint)];
    const Eigen::Isometry3d X_WJ = shot.poses[static_cast<std::size_t>(joint.child)] * joint.X_CJ;
    Stretch stretch;
    stretch.turns = joint.type == model::JointType::revolute;
    stretch.amount = cable.factor * plant_.motion_at(Place::ratio, cable.ratio, x).position;
    const Eigen::Vector3d link =
        joint.X_CJ.linear().transpose() * directions_[static_cast<std::size_t>(joint.child)];
    stretch.link = std::max(link.norm(), 0.05);
    stretch.X_WJ = X_WJ;
    stretch.body = joint.child;
    stretch.X_WJ.linear() = X_WJ.linear() * frame_of(joint.axis.normalized(), link);
    shot.stretches.push_back(stretch);
  }
}

Snapshot Snapshots::at(double time) const {
  Snapshot shot;
  shot.time = std::clamp(time, begin(), end());
  const Eigen::VectorXd x = state_at(time);
  const Model& model = plant_.model();
  shot.poses = model::body_poses(model.skeleton, plant_.joint_positions(x.data()));
  const auto [k, share] = find(motion_.time, time);
  const Eigen::Index next = std::min(k + 1, motion_.time.size() - 1);
  for (std::size_t f = 0; f < motion_.foot_forces.size(); ++f) {
    const model::Foot& foot = model.feet[f];
    const Eigen::Matrix3Xd& force = motion_.foot_forces[f];
    const Eigen::Vector3d below = -foot.radius * Eigen::Vector3d::UnitZ();
    shot.pushes.push_back({shot.poses[static_cast<std::size_t>(foot.body)] * foot.point + below,
                           (1.0 - share) * force.col(k) + share * force.col(next), foot.body});
  }
  if (!motion_.phase.empty()) {
    shot.phase = motion_.phase[static_cast<std::size_t>(share < 0.5 ? k : next)];
  }
  add_stretches(x.data(), shot);
  shot.spring.assign(model.skeleton.bodies.size(), 0.0);
  for (const Spring& spring : springs_) {
    double& most = shot.spring[static_cast<std::size_t>(spring.body)];
    most = std::max(most, deflection(spring, x.data()));
  }
  return shot;
}

double Snapshots::largest_spring() const {
  double largest = 0.0;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant_.states());
  const Eigen::Index stride = std::max<Eigen::Index>(1, motion_.time.size() / 2000);
  for (Eigen::Index k = 0; k < motion_.time.size(); k += stride) {
    x.head(plant_.positions()) = motion_.positions.col(k);
    for (const Spring& spring : springs_) {
      largest = std::max(largest, deflection(spring, x.data()));
    }
  }
  return largest;
}

}  // namespace plumbline::render
