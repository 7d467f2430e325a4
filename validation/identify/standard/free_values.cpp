#include "validation/identify/standard/free_values.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "simulator/effects/parameters.h"
#include "simulator/model/known_effects.h"
#include "simulator/model/link_box.h"
#include "validation/identify/fit/free_parameters.h"

namespace plumbline::validation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMassShare = 0.1;
constexpr double kLeastMassShare = 0.1;
constexpr double kStretch = 0.2;
constexpr double kMostStretch = 1.0;  // matter e times as far from the centre
constexpr double kRotorShare = 0.2;
constexpr double kFeltShare = 0.1;
constexpr double kTorqueConstantShare = 0.1;
constexpr double kLeastTorqueConstant = 0.1;  // of the stated one

/// What is known of one parameter beforehand.
struct Known {
  double spread, lower, upper;
};

int find_use(const model::Model& model, const std::string& effect, const std::string& at) {
  for (std::size_t e = 0; e < model.effects.size(); ++e) {
    if (model.effects[e].at == at && model.effects[e].law->declaration().name == effect) {
      return static_cast<int>(e);
    }
  }
  return -1;
}

class Freeing {
 public:
  Freeing(const model::Model& model, const std::map<std::string, MotorScales>& scales)
      : scales_(scales), known_(model::known_effects()) {
    free_.model = model;
    free_.own = model.effects.size();
  }

  FreeModel result(Freed freed) {
    for (std::size_t b = 0; b < free_.model.skeleton.bodies.size(); ++b) {
      if (freed == Freed::all && free_.model.skeleton.bodies[b].mass > 0.0) {
        body(static_cast<int>(b));
      }
    }
    for (std::size_t m = 0; m < free_.model.motors.size(); ++m) {
      const auto scales = scales_.find(free_.model.motors[m].name);
      if (scales != scales_.end()) {
        motor(free_.model.motors[m], scales->second);
      }
    }
    for (const auto& [at, scales] : scales_) {
      if (free_.model.motor_index(at) < 0) {
        passive_joint(at, scales);
      }
    }
    name();
    return std::move(free_);
  }

 private:
  int use_of(const std::string& effect, const std::string& at) {
    const int found = find_use(free_.model, effect, at);
    if (found >= 0) {
      return found;
    }
    model::EffectUse use;
    use.law = known_.find(effect);
    use.at = at;
    for (const double value : use.law->null_values()) {
      use.values.push_back({value, 0.0, "1", "", true});
    }
    free_.model.effects.push_back(use);
    return static_cast<int>(free_.model.effects.size()) - 1;
  }

  void free(int effect, const std::string& parameter, Known known) {
    const model::EffectUse& use = free_.model.effects[static_cast<std::size_t>(effect)];
    const int index = use.law->parameter_index(parameter);
    const model::Quantity& quantity = use.values[static_cast<std::size_t>(index)];
    FreeValue value;
    value.id = {effect, index};
    value.stated = value.value = quantity.value;
    value.spread = quantity.uncertainty > 0.0 ? quantity.uncertainty : known.spread;
    value.lower = std::min(known.lower, value.stated);
    value.upper = std::max(known.upper, value.stated);
    free_.values.push_back(value);
  }

  void body(int index) {
    const model::Body link = free_.model.skeleton.bodies[static_cast<std::size_t>(index)];
    const double spread = link.mass_uncertainty > 0.0 ? link.mass_uncertainty : kMassShare * link.mass;
    free(use_of("added_mass", link.name), "mass", {spread, -(1.0 - kLeastMassShare) * link.mass, kInfinity});
    const Eigen::AlignedBox3d box = model::link_box(free_.model.skeleton, index);
    const int shift = use_of("com_shift", link.name);
    const std::vector<std::string> axes{"x", "y", "z"};
    for (Eigen::Index i = 0; i < 3; ++i) {
      free(shift, axes[static_cast<std::size_t>(i)],
           {box.sizes().maxCoeff(), box.min()[i] - link.com[i], box.max()[i] - link.com[i]});
    }
    const int tensor = use_of("link_inertia", link.name);
    for (const char* stretch : {"x", "y", "z", "xy", "xz", "yz"}) {
      free(tensor, stretch, {kStretch, -kMostStretch, kMostStretch});
    }
  }

  void motor(const model::Motor& stated, const MotorScales& scales) {
    const model::Motor motor = stated;  // the model's effects are going to move
    const model::Quantity& rotor = motor.rotor_inertia;
    const double generic = std::max(kRotorShare * rotor.value, kFeltShare * scales.inertia);
    free(use_of("rotor_inertia", motor.name), "inertia",
         {rotor.uncertainty > 0.0 ? rotor.uncertainty : generic, -rotor.value, kInfinity});
    const model::Quantity& constant = motor.torque_constant;
    const bool says = constant.uncertainty > 0.0 && constant.value > 0.0;
    free(use_of("torque_constant_error", motor.name), "scale",
         {says ? constant.uncertainty / constant.value : kTorqueConstantShare, kLeastTorqueConstant,
          kInfinity});
    free(use_of("torque_bias", motor.name), "bias", {scales.torque, -kInfinity, kInfinity});
    friction("viscous", "damping", motor.name, scales.torque / scales.velocity, 2);
    smooth(friction("coulomb", "level", motor.name, scales.torque, 1), scales);
  }

  void passive_joint(const std::string& at, const MotorScales& scales) {
    free(use_of("viscous", at), "damping", {scales.torque / scales.velocity, 0.0, kInfinity});
    const int coulomb = use_of("coulomb", at);
    free(coulomb, "level", {scales.torque, 0.0, kInfinity});
    smooth(coulomb, scales);
  }

  /// An added dry friction fades below a small share of the speeds that were seen.
  void smooth(int coulomb, const MotorScales& scales) {
    if (coulomb < static_cast<int>(free_.own)) {
      return;
    }
    model::EffectUse& use = free_.model.effects[static_cast<std::size_t>(coulomb)];
    effects::Scales motion;
    motion.velocity = scales.velocity;
    use.values[static_cast<std::size_t>(use.law->parameter_index("smoothing_speed"))].value =
        effects::smoothing_speed_for(motion);
  }

  /// At the motor, or at a coordinate that it drives where the model has it there; `power` of the ratio by
  /// which the spread grows there.
  int friction(const std::string& effect, const std::string& parameter, const std::string& motor,
               double spread, int power) {
    if (find_use(free_.model, effect, motor) < 0) {
      for (const model::Ratio& ratio : free_.model.ratios) {
        for (std::size_t t = 0; t < ratio.to.size() && ratio.motor == motor; ++t) {
          const int found = find_use(free_.model, effect, ratio.to[t].of);
          if (found >= 0) {
            const double factor = std::pow(std::abs(ratio.ratios[t].value), power);
            free(found, parameter, {factor * spread, 0.0, kInfinity});
            return found;
          }
        }
      }
    }
    const int use = use_of(effect, motor);
    free(use, parameter, {spread, 0.0, kInfinity});
    return use;
  }

  /// Labels and units as overlays have them.
  void name() {
    for (const FreeParameter& parameter : free_parameters(free_.model)) {
      for (FreeValue& value : free_.values) {
        if (value.id.effect == parameter.id.effect && value.id.parameter == parameter.id.parameter) {
          value.label = parameter.label;
          value.unit = parameter.unit;
        }
      }
    }
  }

  const std::map<std::string, MotorScales>& scales_;
  effects::Catalogue known_;
  FreeModel free_;
};

}  // namespace

bool FreedKind::has(const std::string& law) const {
  return std::find(laws.begin(), laws.end(), law) != laws.end();
}

const std::vector<FreedKind>& freed_kinds() {
  static const std::vector<FreedKind> kKinds{
      {"masses, centres of mass and inertias", {"added_mass", "com_shift", "link_inertia"}},
      {"rotor inertias and gains", {"rotor_inertia", "torque_constant_error"}},
      {"offsets of torque", {"torque_bias"}},
      {"friction", {"viscous", "coulomb"}}};
  return kKinds;
}

bool is_freed(const std::string& law) {
  return std::any_of(freed_kinds().begin(), freed_kinds().end(),
                     [&](const FreedKind& kind) { return kind.has(law); });
}

FreeModel free_values(const model::Model& model, const std::map<std::string, MotorScales>& scales,
                      Freed freed) {
  return Freeing(model, scales).result(freed);
}

std::vector<FreeParameter> as_parameters(const FreeModel& free, double scale) {
  const auto together = std::make_shared<const model::Correlations>(free.model.correlations);
  std::vector<FreeParameter> parameters;
  for (const FreeValue& value : free.values) {
    FreeParameter parameter;
    parameter.id = value.id;
    parameter.label = value.label;
    parameter.unit = value.unit;
    parameter.lower = value.lower;
    parameter.upper = value.upper;
    parameter.typical = value.spread;
    parameter.physical = value.physical;
    parameter.together = together;
    if (value.known) {
      parameter.mean = value.stated;
      parameter.deviation = value.spread / scale;
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

Eigen::MatrixXd stated_information(const FreeModel& free) {
  std::vector<std::string> labels;
  std::vector<Eigen::Index> known;
  for (std::size_t i = 0; i < free.values.size(); ++i) {
    if (free.values[i].known) {
      labels.push_back(free.values[i].label);
      known.push_back(static_cast<Eigen::Index>(i));
    }
  }
  const auto all = static_cast<Eigen::Index>(free.values.size());
  const auto count = static_cast<Eigen::Index>(known.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(all, all);
  const Eigen::MatrixXd inverse =
      free.model.correlations.among(labels).llt().solve(Eigen::MatrixXd::Identity(count, count));
  information(known, known) = inverse;
  return information;
}

double stated_misfit(const FreeModel& free) {
  const Eigen::MatrixXd information = stated_information(free);
  Eigen::VectorXd off = Eigen::VectorXd::Zero(information.rows());
  for (std::size_t i = 0; i < free.values.size(); ++i) {
    const FreeValue& value = free.values[i];
    off[static_cast<Eigen::Index>(i)] = value.known ? (value.value - value.stated) / value.spread : 0.0;
  }
  const Eigen::VectorXd pull = information * off;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < off.size(); ++i) {
    sum += off[i] * pull[i];
  }
  return sum;
}

void set_value(model::Model& model, const model::ParameterId& id, double value) {
  model.effects[static_cast<std::size_t>(id.effect)].values[static_cast<std::size_t>(id.parameter)].value =
      value;
}

model::Model identified(const FreeModel& free) {
  model::Model model = free.model;
  for (const FreeValue& value : free.values) {
    set_value(model, value.id, value.value);
  }
  return model;
}

}  // namespace plumbline::validation
