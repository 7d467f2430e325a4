#include "simulator/model/contact_laws.h"

#include <algorithm>

namespace plumbline::model {

void ContactLaws::take(const Model& model, const std::vector<effects::Values>& values,
                       const std::function<bool(const std::string&)>& here, int& next_state) {
  for (int e = 0; e < static_cast<int>(model.effects.size()); ++e) {
    const EffectUse& use = model.effects[static_cast<std::size_t>(e)];
    if (!here(use.at)) {
      continue;
    }
    if (const auto* change = dynamic_cast<const contact::GroundChangeLaw*>(use.law.get())) {
      changes.push_back({change, e});
    }
    if (const auto* turn = dynamic_cast<const contact::TurningLaw*>(use.law.get())) {
      turns.push_back({turn, e});
    }
    if (use.law->is_null(values[static_cast<std::size_t>(e)].data())) {
      continue;
    }
    if (const auto* normal = dynamic_cast<const contact::NormalLaw*>(use.law.get())) {
      normals.push_back({normal, e});
    } else if (const auto* drag = dynamic_cast<const contact::TangentialLaw*>(use.law.get())) {
      drags.push_back({drag, e, drag->state_count() > 0 ? next_state : -1});
      next_state += drag->state_count();
    }
  }
}

void ContactLaws::change(const std::vector<effects::Values>& stated, std::vector<effects::Values>& changed,
                         Applied& applied) {
  height = 0.0;
  for (const Change& use : changes) {
    const contact::GroundChange change = use.law->change(stated[static_cast<std::size_t>(use.effect)].data());
    const auto apply = [&](const auto& law) {
      const std::pair<int, int> both(use.effect, law.effect);
      if (std::find(applied.begin(), applied.end(), both) == applied.end()) {
        law.law->apply(change, changed[static_cast<std::size_t>(law.effect)].data());
        applied.push_back(both);
      }
    };
    height += change.height;
    std::for_each(normals.begin(), normals.end(), apply);
    std::for_each(drags.begin(), drags.end(), apply);
  }
}

Eigen::Vector3d ContactLaws::force(double depth, double rate, const Eigen::Vector2d& slip, const double* x,
                                   const std::vector<effects::Values>& values, double* xdot) const {
  const auto of = [&](int effect) { return values[static_cast<std::size_t>(effect)].data(); };
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (const Normal& use : normals) {
    force.z() += use.law->force(depth, rate, of(use.effect));
  }
  for (const Drag& use : drags) {
    const double* state = use.state >= 0 ? x + use.state : nullptr;
    force.head<2>() += use.law->force(slip, force.z(), state, of(use.effect));
    if (xdot != nullptr && use.state >= 0) {
      use.law->state_rate(slip, force.z(), state, of(use.effect), xdot + use.state);
    }
  }
  return force;
}

Eigen::Vector3d ContactLaws::moment(const Eigen::Vector3d& turn, double normal,
                                    const std::vector<effects::Values>& values) const {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for (const Turn& use : turns) {
    moment += use.law->moment(turn, normal, values[static_cast<std::size_t>(use.effect)].data());
  }
  return moment;
}

}  // namespace plumbline::model
