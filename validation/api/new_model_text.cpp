#include "validation/api/new_model_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "simulator/model/kinds.h"
#include "simulator/trace/number_text.h"
#include "simulator/trace/units.h"

namespace plumbline::api {
namespace {

using model::Body;
using model::Joint;
using model::JointType;
using model::Skeleton;
using validation::ColumnLook;

constexpr int kDigits = 4;
constexpr double kStandardGravity = 9.80665;  // m/s^2, ISO 80000-3

std::string file_name(const std::string& path) { return std::filesystem::path(path).filename().string(); }

/// A JSON text is a YAML text between double quotes.
std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string share(double part) { return number_text(100.0 * part, kDigits) + " %"; }

/// {value: ..., unit: ..., uncertainty: ..., source: "..."}; `key` is source or assumed.
std::string quantity(double value, const std::string& unit, const std::string& uncertainty, const char* key,
                     const std::string& why) {
  return "{value: " + number_text(value, kDigits) + ", unit: " + (unit == "1" ? "\"1\"" : unit) +
         (uncertainty.empty() ? "" : ", uncertainty: " + uncertainty) + ", " + key + ": " + quoted(why) + "}";
}

/// A name that a model may give.
std::string legal_name(const std::string& name) {
  std::string legal;
  for (const char c : name) {
    const bool keeps = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.' || c == '-';
    legal += keeps ? c : '_';
  }
  if (legal.empty() || std::isdigit(static_cast<unsigned char>(legal.front())) != 0) {
    legal.insert(0, "j");
  }
  return legal;
}

std::string unused(std::string name, std::set<std::string>& taken) {
  while (!taken.insert(name).second) {
    name += "_";
  }
  return name;
}

/// Which bodies a joint carries.
std::vector<bool> carried_by(const Skeleton& skeleton, std::size_t joint) {
  std::vector<bool> carried(skeleton.bodies.size(), false);
  carried[static_cast<std::size_t>(skeleton.joints[joint].child)] = true;
  for (const Joint& other : skeleton.joints) {  // parents before children
    if (other.parent >= 0 && carried[static_cast<std::size_t>(other.parent)]) {
      carried[static_cast<std::size_t>(other.child)] = true;
    }
  }
  return carried;
}

std::vector<Eigen::Isometry3d> poses_at_zero(const Skeleton& skeleton) {
  std::vector<Eigen::Isometry3d> poses(skeleton.bodies.size(), Eigen::Isometry3d::Identity());
  for (const Joint& joint : skeleton.joints) {
    const Eigen::Isometry3d parent =
        joint.parent < 0 ? Eigen::Isometry3d::Identity() : poses[static_cast<std::size_t>(joint.parent)];
    poses[static_cast<std::size_t>(joint.child)] = parent * joint.X_PJ * joint.X_CJ.inverse();
  }
  return poses;
}

/// What a joint moves with all joints at zero: sum of a' (I + m (r^2 1 - r r')) a, or of the masses.
double moved_inertia(const Skeleton& skeleton, std::size_t index,
                     const std::vector<Eigen::Isometry3d>& poses) {
  const Joint& joint = skeleton.joints[index];
  const Eigen::Isometry3d X_WJ = poses[static_cast<std::size_t>(joint.child)] * joint.X_CJ;
  const Eigen::Vector3d axis = X_WJ.linear() * joint.axis.normalized();
  const std::vector<bool> carried = carried_by(skeleton, index);
  double sum = 0.0;
  for (std::size_t b = 0; b < skeleton.bodies.size(); ++b) {
    const Body& body = skeleton.bodies[b];
    if (!carried[b]) {
      continue;
    }
    const Eigen::Vector3d a_B = poses[b].linear().transpose() * axis;
    const Eigen::Vector3d arm = axis.cross(poses[b] * body.com - X_WJ.translation());
    sum += joint.type == JointType::prismatic ? body.mass
                                              : a_B.dot(body.inertia * a_B) + body.mass * arm.squaredNorm();
  }
  return sum;
}

/// That of the column, where it is one of what is wanted.
std::string unit_of(const ColumnLook& column, const std::string& wanted) {
  return !column.unit.empty() && units_agree(column.unit, wanted) ? column.unit : wanted;
}

/// A position that scatters by less of its range (17 bits) is no encoder's.
constexpr double kFinest = 1e-5;

class ModelWriter {
 public:
  explicit ModelWriter(const Plan& plan) : plan_(plan), file_(file_name(plan.skeleton_path)) {}

  std::string text() {
    write_head();
    write_masses();
    write_coordinates();
    write_motors();
    write_ratios();
    write_effects();
    write_sensors();
    return out_.str();
  }

 private:
  void write_head() {
    out_ << "# Made by `plumbline new-model` from " << file_
         << ". What is `assumed` is a guess: put your data sheet's value and its source there,\n"
            "# and an uncertainty that you believe. Values from the skeleton are as good as the skeleton.\n"
            "plumbline: model/1\n"
         << "robot: " << quoted(std::filesystem::path(file_).stem().string()) << "\n"
         << "skeleton: " << quoted(plan_.skeleton_path) << "\n";
    if (plan_.floating_base) {
      out_ << "floating_base: true  # no joint of the skeleton leads to its root link\n";
    }
    for (const std::string& sentence : plan_.skeleton->left_out) {
      if (is_taken_by_new_model(sentence)) {
        continue;
      }
      std::string line = sentence;
      std::replace(line.begin(), line.end(), '\n', ' ');
      out_ << "# Not taken over: " << line << "\n";
    }
    const double gravity = plan_.skeleton->gravity.norm();
    const bool standard = std::abs(gravity - kStandardGravity) < 1e-9;
    out_ << "gravity: {value: " << number_text(gravity) << ", unit: m/s^2, "
         << (standard ? "assumed: \"standard gravity; correct it for your place\""
                      : "source: " + quoted(file_ + ": gravity of its world"))
         << "}\n\n";
  }

  void write_masses() {
    const std::vector<bool> moving = moving_bodies();
    std::ostringstream lines;
    for (std::size_t b = 0; b < moving.size(); ++b) {
      const Body& body = plan_.skeleton->bodies[b];
      if (moving[b] && body.mass > 0.0) {
        lines << "  " << quoted(body.name) << ": {uncertainty: 10 %, assumed: "
              << quoted("no source says how well " + file_ + " knows its " + number_text(body.mass, kDigits) +
                        " kg")
              << "}\n";
      }
    }
    if (!lines.str().empty()) {
      out_ << "# The masses are those of the skeleton. Weigh what you can and state how well you know it.\n"
              "masses:\n"
           << lines.str() << "\n";
    }
  }

  std::vector<bool> moving_bodies() const {
    std::vector<bool> moving(plan_.skeleton->bodies.size(), false);
    for (const Joint& joint : plan_.skeleton->joints) {
      const bool carried = joint.parent >= 0 && moving[static_cast<std::size_t>(joint.parent)];
      moving[static_cast<std::size_t>(joint.child)] = carried || joint.type != JointType::fixed;
    }
    return moving;
  }

  void write_coordinates() {
    out_ << "coordinates:\n";
    for (const PlannedJoint& one : plan_.joints) {
      out_ << "  " << one.coordinate << ": {of: {" << quoted(one.joint->name) << ": 1}}\n";
    }
    out_ << "\n";
  }

  void write_motors() {
    out_ << "# One motor at each joint, all of its numbers at the joint (behind the gears). Delete the motor "
            "and\n"
            "# the ratio of a joint that nothing drives. With a data sheet of motor and gear: the motor's "
            "own\n"
            "# numbers here, and the gear's ratio below.\n"
            "motors:\n";
    for (const PlannedJoint& one : plan_.joints) {
      if (!plan_.is_driven(one)) {
        continue;
      }
      const bool angular = one.columns.angular;
      write_actuator(one);
      out_ << "  " << one.motor << ":\n    command_unit: " << command_unit_at(plan_.command_unit, angular)
           << "\n    rotor_inertia: " << rotor(one) << "\n";
      if (plan_.command_unit == "A") {
        out_ << "    torque_constant: "
             << quantity(one.gain.value, model::force_unit(angular) + "/A", share(one.gain.share), "assumed",
                         one.gain.why)
             << "\n";
      }
      if (one.actuator != nullptr && one.actuator->limit > 0.0) {
        out_ << "    torque_limit: "
             << quantity(one.actuator->limit, model::force_unit(angular), "", "source",
                         file_ + ": range of " + actuator(one))
             << "\n";
      }
    }
    out_ << "\n";
  }

  static std::string actuator(const PlannedJoint& one) {
    return "<" + one.actuator->kind + ">" + (one.actuator->name.empty() ? "" : " " + one.actuator->name);
  }

  void write_actuator(const PlannedJoint& one) {
    if (one.actuator == nullptr) {
      return;
    }
    const std::string force = model::force_unit(one.columns.angular);
    const std::string position = model::position_unit(one.columns.angular);
    const bool servo = one.actuator->stiffness != 0.0 || one.actuator->damping != 0.0;
    out_ << "  # " << file_ << ": " << actuator(one)
         << (servo ? ", a servo of " + number_text(one.actuator->stiffness, kDigits) + " " + force + "/" +
                         position + " and " + number_text(one.actuator->damping, kDigits) + " " + force +
                         " s/" + position + ". Here the command is the torque that it asked for."
                   : std::string())
         << "\n";
  }

  std::string rotor(const PlannedJoint& one) const {
    const std::string unit = model::inertia_unit(one.columns.angular);
    return one.joint->armature > 0.0
               ? quantity(one.joint->armature, unit, "20 %", "source",
                          file_ + ": armature of joint " + one.joint->name + "; its uncertainty is assumed")
               : quantity(one.small_inertia, unit, "10000 %", "assumed",
                          "one hundredth of what the joint moves, uncertain by as much as that: behind a "
                          "gear a rotor counts with the ratio squared");
  }

  void write_ratios() {
    out_ << "ratios:\n";
    for (const PlannedJoint& one : plan_.joints) {
      if (!plan_.is_driven(one)) {
        continue;
      }
      out_ << "  " << one.coordinate << ": {motor: " << one.motor
           << ", ratio: " << quantity(1.0, "1", "", "assumed", "all numbers of the motor are at the joint")
           << "}\n";
    }
    out_ << "\n";
  }

  void write_effects() {
    std::ostringstream lines;
    for (const PlannedJoint& one : plan_.joints) {
      const bool angular = one.columns.angular;
      const std::string force = model::force_unit(angular);
      write_effect(one, "viscous", "damping", one.joint->damping,
                   force + " s/" + model::position_unit(angular), lines);
      write_effect(one, "coulomb", "level", one.joint->friction, force, lines);
      write_effect(one, "spring", "stiffness", one.joint->stiffness,
                   force + "/" + model::position_unit(angular), lines);
      if (one.joint->stiffness > 0.0 && one.joint->rest != 0.0) {
        lines << "      rest: "
              << quantity(one.joint->rest, model::position_unit(angular), "", "source",
                          file_ + ": rest of the spring of joint " + one.joint->name)
              << "\n";
      }
    }
    if (lines.str().empty()) {
      out_ << "# The skeleton states no damping or friction of a joint: none is in the model. `plumbline "
              "diagnose`\n"
              "# asks whether the log shows it; `plumbline add viscous --at JOINT` puts it in.\n\n";
      return;
    }
    out_ << "# What the skeleton states under damping, friction and stiffness. `check` still says that they "
            "stand "
            "there.\n"
            "effects:\n"
         << lines.str() << "\n";
  }

  void write_effect(const PlannedJoint& one, const char* effect, const char* parameter, double value,
                    const std::string& unit, std::ostringstream& lines) const {
    if (value > 0.0) {
      lines << "  - effect: " << effect << "\n    at: " << one.coordinate << "\n    values:\n      "
            << parameter << ": "
            << quantity(value, unit, "50 %", "source",
                        file_ + ": " + (parameter == std::string("level") ? "friction" : parameter) +
                            " of joint " + one.joint->name + "; its uncertainty is assumed")
            << "\n";
    }
  }

  void write_sensors() {
    out_ << "# A sensor for each joint. Resolution and noise decide what counts as an error: state those of "
            "your\n"
            "# encoder (counts_per_turn and gear, or resolution). A log with many digits shows its digits, "
            "not\n"
            "# the encoder, and a log that was filtered shows no noise.\n"
            "sensors:\n";
    for (const PlannedJoint& one : plan_.joints) {
      const std::string unit = model::position_unit(one.columns.angular);
      out_ << "  " << one.coordinate << ": {measures: " << one.coordinate
           << ", resolution: " << resolution(one, unit) << ", noise: " << noise(one, unit) << "}\n";
    }
  }

  /// What a column scatters beyond its quantisation.
  std::string noise(const PlannedJoint& one, const std::string& unit) const {
    if (plan_.look != nullptr && one.columns.position >= 0) {
      const ColumnLook& column = plan_.look->columns[static_cast<std::size_t>(one.columns.position)];
      const double beyond = column.scatter * column.scatter - column.step * column.step / 12.0;
      const double finest = kFinest * (column.highest - column.lowest);
      if (beyond > finest * finest) {
        return quantity(std::sqrt(beyond), unit_of(column, unit), "", "source",
                        file_name(plan_.look->file) + ": scatter of column " + column.name +
                            " about a smooth motion, beyond its steps");
      }
      if (column.step < finest) {
        return quantity(finest, unit_of(column, unit), "", "assumed",
                        "1e-5 of its range: column " + column.name +
                            " is smoother than an encoder, so filtered or computed");
      }
    }
    return one.noise > 0.0 ? quantity(one.noise, unit, "", "source", file_ + ": noise of its <jointpos>")
                           : quantity(0.0, unit, "", "assumed", "quantisation only");
  }

  std::string resolution(const PlannedJoint& one, const std::string& unit) const {
    if (plan_.look != nullptr && one.columns.position >= 0) {
      const ColumnLook& column = plan_.look->columns[static_cast<std::size_t>(one.columns.position)];
      if (column.step > 0.0) {
        return quantity(column.step, unit_of(column, unit), "", "source",
                        file_name(plan_.look->file) + ": smallest step of column " + column.name);
      }
    }
    return quantity(1e-4, unit, "", "assumed", "no log and no data sheet: put the encoder's here");
  }

  const Plan& plan_;
  std::string file_;
  std::ostringstream out_;
};

/// `NAME: {column: ..., unit: ...}`, or a comment where no column matched.
std::string channel(const Plan& plan, const std::string& name, int index, const std::string& unit) {
  if (index < 0) {
    return "  # " + name + ": {column: ..., unit: " + unit + "}   # no column matched\n";
  }
  const ColumnLook& column = plan.look->columns[static_cast<std::size_t>(index)];
  return "  " + name + ": {column: " + quoted(column.name) + ", unit: " + unit_of(column, unit) + "}" +
         (column.unit.empty() || column.unit_is_guess ? "   # unit guessed" : "") + "\n";
}

using ColumnOf = int JointColumns::*;

void write_channels(const Plan& plan, ColumnOf which, const char* section, std::ostringstream& out) {
  const bool any = std::any_of(plan.joints.begin(), plan.joints.end(),
                               [&](const PlannedJoint& one) { return one.columns.*which >= 0; });
  out << (any ? "" : "# ") << section << ":\n";
  for (const PlannedJoint& one : plan.joints) {
    const bool is_command = which == &JointColumns::command;
    if (plan.is_held(one) || (is_command && !plan.is_driven(one))) {
      continue;
    }
    const bool angular = one.columns.angular;
    out << channel(plan, is_command ? one.motor : one.coordinate, one.columns.*which,
                   is_command ? command_unit_at(plan.command_unit, angular) : model::position_unit(angular));
  }
}

void write_locked(const Plan& plan, std::ostringstream& out) {
  const bool any = std::any_of(plan.joints.begin(), plan.joints.end(),
                               [&](const PlannedJoint& one) { return plan.is_held(one); });
  if (!any) {
    return;
  }
  out << "# The log has no column of these: they are taken as held where they are at zero.\nlocked:\n";
  for (const PlannedJoint& one : plan.joints) {
    if (plan.is_held(one)) {
      out << "  " << one.coordinate << ": {value: 0, unit: " << model::position_unit(one.columns.angular)
          << "}\n";
    }
  }
}

bool any_missing(const Plan& plan) {
  const auto missing = [&](int index) {
    return index >= 0 && plan.look->columns[static_cast<std::size_t>(index)].missing > 0;
  };
  return std::any_of(plan.joints.begin(), plan.joints.end(), [&](const PlannedJoint& one) {
    return missing(one.columns.position) || missing(one.columns.command);
  });
}

}  // namespace

bool is_taken_by_new_model(const std::string& left_out) { return left_out.rfind("<actuator>", 0) == 0; }

std::vector<PlannedJoint> plan_joints(const Skeleton& skeleton) {
  std::set<std::string> taken;
  for (const Joint& joint : skeleton.joints) {
    taken.insert(joint.name);
  }
  const std::vector<Eigen::Isometry3d> poses = poses_at_zero(skeleton);
  std::vector<PlannedJoint> planned;
  for (std::size_t j = 0; j < skeleton.joints.size(); ++j) {
    const Joint& joint = skeleton.joints[j];
    // Nothing drives a floating base, and a joint that mimics another one goes with it.
    if (joint.type == JointType::fixed || joint.floats || !joint.mimics.empty()) {
      continue;
    }
    PlannedJoint one;
    one.joint = &joint;
    one.columns.joint = joint.name;
    one.columns.angular = joint.type == JointType::revolute;
    const std::string name = legal_name(joint.name);
    one.coordinate = name == joint.name ? name : unused(name, taken);
    one.motor = unused(one.coordinate + "_motor", taken);
    constexpr double kPart = 0.01;
    constexpr double kLeast = 1e-6;  // kg m^2 or kg: a mass matrix needs something
    one.small_inertia = std::max(kPart * moved_inertia(skeleton, j, poses), kLeast);
    planned.push_back(std::move(one));
  }
  return planned;
}

void add_drives(const model::MjcfDrives& drives, std::vector<PlannedJoint>& joints) {
  for (PlannedJoint& one : joints) {
    for (const model::MjcfActuator& actuator : drives.actuators) {
      if (actuator.joint == one.joint->name && one.actuator == nullptr) {
        one.actuator = &actuator;
        one.has_drive = true;
      }
    }
    const auto noise = drives.position_noise.find(one.joint->name);
    one.noise = noise == drives.position_noise.end() ? 0.0 : noise->second;
  }
}

void add_transmissions(const std::set<std::string>& driven, std::vector<PlannedJoint>& joints) {
  for (PlannedJoint& one : joints) {
    one.has_drive = one.has_drive || driven.count(one.joint->name) != 0;
  }
}

bool Plan::is_driven(const PlannedJoint& one) const {
  const auto said = [](const PlannedJoint& joint) { return joint.has_drive || joint.columns.command >= 0; };
  const bool file_says =
      std::any_of(joints.begin(), joints.end(), [](const PlannedJoint& joint) { return joint.has_drive; });
  const bool nothing_known = std::none_of(joints.begin(), joints.end(), said);
  return said(one) || nothing_known || (!file_says && is_held(one));
}

bool Plan::is_held(const PlannedJoint& one) const {
  const auto silent = [](const PlannedJoint& joint) {
    return joint.columns.position < 0 && joint.columns.command < 0;
  };
  return silent(one) && !std::all_of(joints.begin(), joints.end(), silent);
}

std::string model_text(const Plan& plan) { return ModelWriter(plan).text(); }

std::string trial_text(const Plan& plan, validation::Role role, double from, double to,
                       const std::string& data, const std::string& model_file) {
  const ColumnLook& time = plan.look->columns[static_cast<std::size_t>(plan.look->time)];
  std::ostringstream out;
  out << "# Made by `plumbline new-model` from " << file_name(data)
      << ". Signs, and what is marked as a guess, want a look.\n"
      << "# Both trials are parts of one recording. A held-out motion of another kind says more: record "
         "one.\n"
      << "plumbline: trial/1\n"
      << "title: " << quoted(file_name(data) + ", " + to_string(role)) << "\n"
      << "model: " << quoted(model_file) << "\nrole: " << to_string(role) << "\ndata: " << quoted(data)
      << "\ntime: {column: " << quoted(time.name) << ", unit: " << time.unit << "}"
      << (time.unit_is_guess ? "   # unit guessed" : "") << "\nsection: {from: {value: " << number_text(from)
      << ", unit: s}, to: {value: " << number_text(to) << ", unit: s}}\n";
  if (any_missing(plan)) {
    out << "missing: fill   # cells without a number are bridged; long runs are no part of the trial\n";
  }
  write_channels(plan, &JointColumns::command, "commands", out);
  write_channels(plan, &JointColumns::position, "measured", out);
  write_locked(plan, out);
  return out.str();
}

}  // namespace plumbline::api
