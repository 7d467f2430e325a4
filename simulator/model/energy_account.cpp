#include "simulator/model/energy_account.h"

namespace plumbline::model {
namespace {

// As for feet, what bristles take is booked as it goes.
void add_power_of_links(const PlantDynamics& plant, const double* x, Energetics& e) {
  const LinkContacts* links = plant.links();
  const std::vector<effects::Values>& values = plant.on_ground();
  for (int point = 0; point < plant.link_points(); ++point) {
    LinkTouch at = links->touch(point, plant.bodies().tree());
    links->press(point, x, values, at, nullptr);
    for (const ContactLaws::Normal& use : links->laws(point).normals) {
      const double* p = values[static_cast<std::size_t>(use.effect)].data();
      e.stored += use.law->stored_energy(at.depth, p);
      e.dissipated += use.law->dissipated_power(at.depth, at.rate(), p);
    }
    const Eigen::Vector3d drag = at.force - at.normal().dot(at.force) * at.normal();
    e.dissipated -= drag.dot(at.velocity);
  }
}

}  // namespace

Energetics energetics(PlantDynamics& plant, const double* x, const double* command) {
  plant.deliver_torques(x, command, nullptr);
  plant.bodies().rigid_at(x);
  plant.aim_rods(x);
  Energetics e = powers(plant, x);
  e.stored += plant.bodies().energy(x);
  return e;
}

Energetics powers(const PlantDynamics& plant, const double* x) {
  Energetics e;
  const Eigen::Map<const Eigen::VectorXd> w(x + plant.positions(), plant.positions());
  for (int m = 0; m < plant.motors(); ++m) {
    e.input += plant.torques()[m] * plant.motor_lines()[static_cast<std::size_t>(m)].reduced.dot(w);
  }
  for (const ForceSlot& slot : plant.forces()) {
    if (!slot.active) {
      continue;
    }
    const effects::Motion at = plant.motion(slot, x);
    const double* state = slot.state >= 0 ? x + slot.state : nullptr;
    e.stored += slot.law->stored_energy(at, state, plant.values(slot.effect));
    e.dissipated += slot.law->dissipated_power(at, state, plant.values(slot.effect));
  }
  plant.feet().add_power(plant.bodies().tree(), x, plant.on_ground(), e);
  add_power_of_links(plant, x, e);
  return e;
}

}  // namespace plumbline::model
