#include "simulator/model/skeleton_values.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "simulator/model/body_change.h"
#include "simulator/model/kinds.h"
#include "simulator/trace/number_text.h"

namespace plumbline::model {
namespace {

using effects::Place;

constexpr int kDeepest = 16;        // coordinates over pulleys over coordinates: more is a circle
constexpr int kSentenceDigits = 6;  // of numbers in sentences

struct OneJoint {
  std::size_t joint = 0;
  double factor = 0.0;
};

class Collector {
 public:
  explicit Collector(const Model& model) : model_(model) {
    values_.bodies = model.skeleton.bodies;
    values_.joints.resize(model.skeleton.joints.size());
    values_.gravity = model.skeleton.gravity;
  }

  SkeletonValues collect() {
    take_inertias();
    for (const EffectUse& use : model_.effects) {
      if (!use.law->is_null(use.numbers().data())) {
        take(use);
      }
    }
    if (fades_) {
      leave_out("Coulomb friction: the speed below which it fades (smoothing_speed).");
    }
    for (const Ratio& ratio : model_.ratios) {
      if (find_joint(model_.skeleton, ratio.motor) != nullptr) {
        leave_out("The tie of joint " + ratio.motor + " to " + ratio.name + ": the joint is free.");
      }
    }
    name_drives();
    return std::move(values_);
  }

 private:
  void leave_out(const std::string& sentence) { values_.left_out.push_back(sentence); }

  /// Turns of every joint of the skeleton's for one turn of what is named; empty where that is not known.
  Eigen::RowVectorXd row(const std::string& name, int depth = 0) const {
    const auto count = static_cast<Eigen::Index>(model_.skeleton.joints.size());
    const Coordinate* coordinate = model_.find_coordinate(name);
    if (coordinate != nullptr && coordinate->terms.front().of != name) {
      return sum(coordinate->terms, depth);
    }
    for (Eigen::Index j = 0; j < count; ++j) {
      const Joint& joint = model_.skeleton.joints[static_cast<std::size_t>(j)];
      if (joint.name == name && joint.type != JointType::fixed) {
        const double factor = coordinate != nullptr ? coordinate->terms.front().factor : 1.0;
        return factor * Eigen::RowVectorXd::Unit(count, j);
      }
    }
    const auto ratio = std::find_if(model_.ratios.begin(), model_.ratios.end(),
                                    [&](const Ratio& one) { return one.motor == name; });
    return ratio == model_.ratios.end() ? Eigen::RowVectorXd() : sum(ratio->to, depth);
  }

  Eigen::RowVectorXd sum(const std::vector<Term>& terms, int depth) const {
    Eigen::RowVectorXd total =
        Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(model_.skeleton.joints.size()));
    for (const Term& term : terms) {
      const Eigen::RowVectorXd one = depth < kDeepest ? row(term.of, depth + 1) : Eigen::RowVectorXd();
      if (one.size() == 0) {
        return one;
      }
      total += term.factor * one;
    }
    return total;
  }

  std::optional<OneJoint> alone(const std::string& name) const {
    const Eigen::RowVectorXd turns = row(name);
    if (turns.size() == 0 || (turns.array() != 0.0).count() != 1) {
      return std::nullopt;
    }
    Eigen::Index joint = 0;
    turns.cwiseAbs().maxCoeff(&joint);
    return OneJoint{static_cast<std::size_t>(joint), turns[joint]};
  }

  void add(const std::string& at, const std::string& what, double JointValues::*which, double amount,
           int power) {
    if (amount == 0.0) {
      return;
    }
    if (const auto one = alone(at)) {
      values_.joints[one->joint].*which += std::pow(std::abs(one->factor), power) * amount;
    } else {
      leave_out(what + " at " + at + ", " + number_text(amount, kSentenceDigits) + " " +
                unit_of(which, is_angular(model_, at)) + ": no joint moves with it alone.");
    }
  }

  static std::string unit_of(double JointValues::*which, bool angular) {
    if (which == &JointValues::armature) {
      return inertia_unit(angular);
    }
    return which == &JointValues::friction ? force_unit(angular)
                                           : force_unit(angular) + " s/" + position_unit(angular);
  }

  void take_inertias() {
    for (const Motor& motor : model_.motors) {
      double added = 0.0;
      for (const EffectUse& use : model_.effects) {
        const auto* law = dynamic_cast<const effects::StructureLaw*>(use.law.get());
        if (law != nullptr && use.at == motor.name && model_.resolve(*law, use.at) == Place::motor) {
          added += law->change(use.numbers().data()).inertia;
        }
      }
      add(motor.name, "The rotor's inertia", &JointValues::armature, motor.rotor_inertia.value + added, 2);
    }
    for (const Pulley& pulley : model_.pulleys) {
      add(pulley.name, "The pulley's inertia", &JointValues::armature, pulley.inertia.value, 2);
    }
    for (const Inertia& inertia : model_.inertias) {
      add(inertia.at, "The inertia " + inertia.name, &JointValues::armature, inertia.value.value, 2);
    }
  }

  void take(const EffectUse& use) {
    const std::string& name = use.law->declaration().name;
    const effects::Values numbers = use.numbers();
    const Place place = model_.resolve(*use.law, use.at);
    const auto* structure = dynamic_cast<const effects::StructureLaw*>(use.law.get());
    if (name == "viscous") {
      add(use.at, "Viscous friction", &JointValues::damping, numbers.front(), 2);
    } else if (name == "coulomb") {
      add(use.at, "Coulomb friction", &JointValues::friction, numbers.front(), 1);
      fades_ = true;
    } else if (structure != nullptr && place == Place::body) {
      const auto body = static_cast<std::size_t>(model_.body_index(use.at));
      change_body(values_.bodies[body], structure->change(numbers.data()), model_.file + ": " + use.label());
    } else if (structure != nullptr && place == Place::world) {
      const Eigen::Vector3d tilt = structure->change(numbers.data()).tilt;
      values_.gravity = Eigen::AngleAxisd(tilt.norm(), tilt.normalized()) * values_.gravity;
    } else if (structure == nullptr || place != Place::motor) {
      leave_out(sentence(use));
    }
  }

  std::string sentence(const EffectUse& use) const {
    std::string text = "The effect " + use.label() + " (";
    const auto& parameters = use.law->declaration().parameters;
    for (std::size_t p = 0; p < parameters.size(); ++p) {
      text +=
          (p == 0 ? "" : ", ") + parameters[p].name + " " + number_text(use.values[p].value, kSentenceDigits);
    }
    return text + ", SI).";
  }

  /// Gears and gains are no part of a skeleton; whoever commands the joint wants them.
  void name_drives() {
    for (const Motor& motor : model_.motors) {
      const auto one = alone(motor.name);
      if (!one) {
        leave_out("Motor " + motor.name + ": it drives no joint, or several together.");
        continue;
      }
      const double gain = one->factor * motor.torque_constant.value;
      if (gain != 1.0) {
        const Joint& joint = model_.skeleton.joints[one->joint];
        leave_out("Motor " + motor.name + ": " + number_text(gain, kSentenceDigits) + " " +
                  force_unit(joint.type == JointType::revolute) + " at joint " + joint.name + " for each " +
                  motor.command_unit + " of its command.");
      }
    }
  }

  const Model& model_;
  SkeletonValues values_;
  bool fades_ = false;
};

}  // namespace

SkeletonValues skeleton_values(const Model& model) { return Collector(model).collect(); }

}  // namespace plumbline::model
