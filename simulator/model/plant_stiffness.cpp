// Which effect of a Plant is the stiffest: for the message of an integrator that gives up.
#include <Eigen/Eigenvalues>
#include <memory>
#include <utility>

#include "simulator/model/plant.h"

namespace plumbline::model {

// Of the linearised equations with the effects that are active now.
double Plant::spectral_radius(const double* x) {
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(nx_, nx_);
  A.block(0, nz_, nz_, nz_).setIdentity();
  effect_tangent(x, nullptr, A);
  return A.allFinite() ? A.eigenvalues().cwiseAbs().maxCoeff() : 0.0;
}

Stiffest Plant::stiffest(const double* x, const double* command) {
  deliver_torques(x, command, nullptr);
  factor_at(x);
  std::vector<ForceSlot> forces = forces_;
  std::vector<FootSlot> feet = feet_;
  forces.swap(forces_);
  feet.swap(feet_);  // `forces`, `feet` and `links` are the plant's own, forces_, feet_ and links_ what acts
  std::unique_ptr<LinkContacts> links = std::move(links_);
  Stiffest found;
  const auto compare = [&](int effect) {
    const double rate = spectral_radius(x);
    if (rate > 1.01 * found.rate) {  // a drag law that adds nothing to the normal law is not to blame
      found = {model_.effects[static_cast<std::size_t>(effect)].label(), rate};
    }
  };
  feet_.clear();
  for (const ForceSlot& slot : forces) {
    if (slot.active) {
      forces_.assign(1, slot);
      compare(slot.effect);
    }
  }
  forces_.clear();
  for (const FootSlot& slot : feet) {
    feet_.assign(1, slot);
    feet_[0].drags.clear();
    compare(slot.normals.front().effect);
    feet_[0].drags = slot.drags;
    if (!slot.drags.empty()) {
      compare(slot.drags.front().effect);
    }
  }
  feet_.clear();
  for (int point = 0; links != nullptr && point < links->points(); ++point) {
    const ContactLaws& laws = links->laws(point);
    links_ = std::make_unique<LinkContacts>(links->only(point, false));
    compare(laws.normals.front().effect);
    links_ = std::make_unique<LinkContacts>(links->only(point, true));
    if (!laws.drags.empty()) {
      compare(laws.drags.front().effect);
    }
  }
  forces_ = std::move(forces);
  feet_ = std::move(feet);
  links_ = std::move(links);
  return found;
}

}  // namespace plumbline::model
