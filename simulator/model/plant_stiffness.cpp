// Which effect of a Plant is the stiffest: for the message of an integrator that gives up.
#include <Eigen/Eigenvalues>

#include "simulator/model/plant_tangent.h"

namespace plumbline::model {

Stiffest PlantTangent::stiffest(const double* x, const double* command) {
  plant_.deliver_torques(x, command, nullptr);
  bodies_.factor_at(x);
  plant_.aim_rods(x);
  Eigen::MatrixXd A(nx_, nx_);
  Stiffest found;
  // Spectral radius of the linearised equations with the one effect alone that `add` adds the slopes of.
  const auto compare = [&](int effect, const auto& add) {
    A.setZero();
    A.block(0, nz_, nz_, nz_).setIdentity();
    slopes_.setZero(nz_, nx_);
    add();
    bodies_.accelerate_in_place(slopes_);
    A.middleRows(nz_, nz_) += slopes_;
    const double rate = A.allFinite() ? A.eigenvalues().cwiseAbs().maxCoeff() : 0.0;
    if (rate > 1.01 * found.rate) {  // a drag law that adds nothing to the normal law is not to blame
      found = {plant_.model().effects[static_cast<std::size_t>(effect)].label(), rate};
    }
  };
  for (const ForceSlot& slot : plant_.forces()) {
    if (slot.active) {
      compare(slot.effect, [&] { force_tangent(slot, x, nullptr, A); });
    }
  }
  const auto add_feet = [&](GroundFeet feet) {
    feet.add_slopes(bodies_.tree(), x, plant_.on_ground(), nullptr, slopes_, A);
  };
  for (const FootSlot& slot : plant_.feet().slots()) {
    compare(slot.normals.front().effect, [&] { add_feet(plant_.feet().only(slot, false)); });
    if (!slot.drags.empty()) {
      compare(slot.drags.front().effect, [&] { add_feet(plant_.feet().only(slot, true)); });
    }
  }
  for (int point = 0; point < plant_.link_points(); ++point) {
    const LinkContacts& links = *plant_.links();
    const ContactLaws& laws = links.laws(point);
    compare(laws.normals.front().effect, [&] { link_tangent(links.only(point, false), x, nullptr, A); });
    if (!laws.drags.empty()) {
      compare(laws.drags.front().effect, [&] { link_tangent(links.only(point, true), x, nullptr, A); });
    }
  }
  return found;
}

}  // namespace plumbline::model
