#include "validation/studies/recipes/posture.h"

#include <algorithm>

#include "validation/identify/twin/twin.h"

namespace plumbline::validation {
namespace {

/// A pose as the start of an experiment, which already knows how to find positions from coordinates.
Experiment as_experiment(const Postures::Pose& pose) {
  Experiment experiment;
  experiment.time = Eigen::VectorXd::Zero(1);
  for (const auto& [name, value] : pose.at) {
    experiment.start.push_back({name, value});
  }
  return experiment;
}

std::vector<model::Lock> locks_of(const Postures& postures, const std::vector<double>& held) {
  std::vector<model::Lock> locks;
  for (std::size_t i = 0; i < postures.locked.size(); ++i) {
    locks.push_back({postures.locked[i], held[i]});
  }
  return locks;
}

}  // namespace

double total_weight(const model::Model& model) {
  double mass = 0.0;
  for (const model::Body& body : model.skeleton.bodies) {
    mass += body.mass;
  }
  for (const model::EffectUse& use : model.effects) {
    if (const auto* law = dynamic_cast<const effects::StructureLaw*>(use.law.get())) {
      mass += law->change(use.numbers().data()).mass;
    }
  }
  return mass * model.skeleton.gravity.norm();
}

Posture::Posture(const model::Model& model, const Postures& postures, const Postures::Pose& pose,
                 const std::vector<double>& held)
    : postures_(postures), pose_(pose), locks_(locks_of(postures, held)), plant_(model, locks_) {}

Eigen::VectorXd Posture::start_of(model::Plant& plant) const {
  return start_state(plant, as_experiment(pose_)).head(plant.positions());
}

Eigen::VectorXd Posture::balance(model::Plant& plant, const Eigen::VectorXd& near) {
  const Eigen::VectorXd idle = Eigen::VectorXd::Zero(plant.motors());
  Eigen::VectorXd x = Eigen::VectorXd::Zero(plant.states());
  x.head(plant.positions()) = plant.equilibrium(near, idle.data());
  return x;
}

Eigen::VectorXd Posture::readings(double offset) {
  Eigen::VectorXd x = balance(plant_, start_of(plant_));
  Eigen::VectorXd y(plant_.sensors());
  plant_.outputs(x.data(), y.data());
  if (offset == 0.0) {
    return y;
  }
  std::vector<model::Lock> locks = locks_;
  locks.push_back({postures_.balanced, plant_.position_of(postures_.balanced, x.data()) + offset});
  model::Plant held(plant_.model(), locks);
  x = balance(held, start_of(held));
  held.outputs(x.data(), y.data());
  return y;
}

std::vector<double> held_by_pose(const model::Model& model, const Postures& postures,
                                 const Postures::Pose& pose) {
  model::Plant plant(model, {});
  const Eigen::VectorXd x = start_state(plant, as_experiment(pose));
  std::vector<double> held;
  for (const std::string& name : postures.locked) {
    held.push_back(plant.position_of(name, x.data()));
  }
  return held;
}

std::vector<double> held_by_readings(const model::Model& model, const Postures& postures,
                                     const Eigen::VectorXd& readings) {
  std::vector<double> held;
  for (const std::string& name : postures.locked) {
    const auto sensor = std::find_if(model.sensors.begin(), model.sensors.end(),
                                     [&](const model::Sensor& one) { return one.measures == name; });
    held.push_back(readings[sensor - model.sensors.begin()]);
  }
  return held;
}

}  // namespace plumbline::validation
