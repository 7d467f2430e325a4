#include "validation/studies/step_down/contact_intensity.h"

#include "simulator/run/start.h"
#include "simulator/trace/error.h"

namespace plumbline::validation {

ContactIntensity::ContactIntensity(const RigidGait& design)
    : design_(design), plant_(design.model, {}), contact_(plant_) {
  names_ = {design.base[0], design.base[1], design.torso};
  for (const GaitLeg* leg : {&design.stance, &design.swing}) {
    names_.insert(names_.end(), {leg->angle, leg->shape, leg->spring});
  }
}

Eigen::Vector3d ContactIntensity::of(const model::Plant& plant, const Eigen::VectorXd& x,
                                     const std::string& foot) {
  const bool swings = foot == design_.swing.foot;
  if (!swings && foot != design_.stance.foot) {
    throw InputError(design_.file + ": no leg has the foot '" + foot + "'");
  }
  run::Start start;
  for (const std::string& name : names_) {
    start.positions.emplace_back(name, plant.position_of(name, x.data()));
    start.velocities.emplace_back(name, plant.velocity_of(name, x.data()));
  }
  Eigen::VectorXd state = run::start_state(plant_, start);
  const GaitLeg& old = swings ? design_.stance : design_.swing;
  const int index = contact_.kinematics().index_of(foot);
  return contact_.strike({{index}, {old.spring}}, state.data()).feet.front();
}

}  // namespace plumbline::validation
