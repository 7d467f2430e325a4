#include "validation/identify/diagnose/physical_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "simulator/model/link_box.h"

namespace plumbline::validation {
namespace {

struct Limits {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
};

double longest_link(const model::Skeleton& skeleton) {
  double longest = 0.0;
  for (std::size_t b = 0; b < skeleton.bodies.size(); ++b) {
    longest = std::max(longest, link_box(skeleton, static_cast<int>(b)).diagonal().norm());
  }
  return longest;
}

Limits limits_in_space(const model::Model& model, const model::EffectUse& use, int axis) {
  const bool hangs = use.law->declaration().name == "payload";
  const int index = model.body_index(use.at);
  const Eigen::AlignedBox3d box = link_box(model.skeleton, index);
  const double beyond = hangs ? longest_link(model.skeleton) : 0.0;
  const double from = hangs ? 0.0 : model.skeleton.bodies[static_cast<std::size_t>(index)].com[axis];
  return {box.min()[axis] - beyond - from, box.max()[axis] + beyond - from};
}

double inertia_at(const model::Model& model, const model::Motor& motor) {
  double inertia = motor.rotor_inertia.value;
  for (const model::Inertia& one : model.inertias) {
    inertia += one.at == motor.name ? one.value.value : 0.0;
  }
  return inertia;
}

Limits limits_of(const model::Model& model, const model::EffectUse& use, int parameter) {
  constexpr double kLeft = 0.1;
  const std::string& law = use.law->declaration().name;
  const int body = model.body_index(use.at);
  if (law == "com_shift" && body >= 0) {
    return limits_in_space(model, use, parameter);
  }
  if (law == "payload" && body >= 0 && parameter > 0) {
    return limits_in_space(model, use, parameter - 1);
  }
  Limits limits;
  if (law == "link_inertia") {
    return {-1.0, 1.0};  // matter e times as far from the centre, or as near
  }
  if (law == "torque_ripple" && parameter < 2) {
    return {-1.0, 1.0};  // beyond, the motor would push back within a cycle
  }
  if (law == "added_mass" && body >= 0) {
    limits.lower = (kLeft - 1.0) * model.skeleton.bodies[static_cast<std::size_t>(body)].mass;
  } else if (law == "torque_constant_error") {
    limits.lower = kLeft;
  } else if (law == "rotor_inertia" && model.find_motor(use.at) != nullptr) {
    limits.lower = (kLeft - 1.0) * inertia_at(model, *model.find_motor(use.at));
  }
  return limits;
}

}  // namespace

void keep_physical(const model::Model& model, const model::EffectUse& use, FreeParameter& parameter) {
  const Limits limits = limits_of(model, use, parameter.id.parameter);
  const double value = use.values[static_cast<std::size_t>(parameter.id.parameter)].value;
  parameter.physical = std::isfinite(limits.lower) || std::isfinite(limits.upper);
  parameter.lower = std::max(parameter.lower, std::min(value, limits.lower));
  parameter.upper = std::min(parameter.upper, std::max(value, limits.upper));
}

void keep_physical(const effects::Scales& motion, const model::EffectUse& use, FreeParameter& parameter) {
  if (use.law->declaration().name == "resonator" &&
      parameter.id.parameter == use.law->parameter_index("inertia")) {
    const double value = use.values[static_cast<std::size_t>(parameter.id.parameter)].value;
    parameter.physical = true;
    parameter.upper = std::min(parameter.upper, std::max(value, motion.inertia));
  }
}

}  // namespace plumbline::validation
