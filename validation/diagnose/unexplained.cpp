#include "validation/diagnose/unexplained.h"

#include <algorithm>
#include <cmath>

#include "validation/inverse_model/inverse_model.h"

namespace plumbline::validation {
namespace {

UnexplainedForce analyse(const NeededForce& force, const Trial& trial, bool angular) {
  UnexplainedForce out;
  out.trial = trial.name;
  out.motor = force.motor;
  out.unit = force.unit;
  out.role = trial.role;
  const Eigen::VectorXd left = force.recorded - force.needed;
  out.rms = std::sqrt(left.squaredNorm() / static_cast<double>(left.size()));
  out.relative = left.norm() / std::max(force.recorded.norm(), 1e-300);
  const Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(left.size(), 0.0, static_cast<double>(left.size()) * trial.period);
  out.dependences =
      dependences_of({left, force.position, force.velocity, force.recorded, time, force.unit, angular});
  out.words = in_words(out.dependences);
  return out;
}

}  // namespace

std::vector<UnexplainedForce> unexplained_forces(const model::Model& model, const Data& data) {
  std::vector<UnexplainedForce> all;
  for (const Trial& trial : data.trials) {
    const InverseModel inverse = inverse_model(model, trial, {});
    for (const NeededForce& force : inverse.motors) {
      const model::Motor* motor = model.find_motor(force.motor);
      all.push_back(analyse(force, trial, motor == nullptr || motor->angular));
    }
  }
  return all;
}

}  // namespace plumbline::validation
