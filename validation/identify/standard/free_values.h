// Which of a model's values standard identification moves, how far it trusts what is stated, and their
// limits.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "validation/identify/predict/windows.h"

namespace plumbline::validation {

/// Of one motor, or of a joint that moves without one, over the train trials; SI.
struct MotorScales {
  double torque = 0.0;    ///< root mean square of the recorded one
  double velocity = 0.0;  ///< root mean square
  double inertia = 0.0;   ///< that it feels, mean
};

/// One parameter of one of the model's effects.
struct FreeValue {
  std::string label;  ///< "added_mass@thigh:mass", as overlays name it
  std::string unit;
  model::ParameterId id;
  double stated = 0.0;  ///< what the model says (0 of an effect that it does not have, 1 of a scale)
  double spread = 0.0;  ///< one standard deviation of that
  double lower = 0.0;   ///< physical limits
  double upper = 0.0;
  double value = 0.0;      ///< identified
  double deviation = 0.0;  ///< one standard deviation with what is stated and the data
  bool physical = false;   ///< its limits say what the robot can be: a value at one is none
  bool known = true;       ///< spread counts as knowledge; else it is a scale only
  bool seen = true;        ///< the data depend on it; else it stays as stated
  bool at_limit = false;

  /// Is it where the robot cannot be?
  bool is_unphysical() const { return physical && (value <= lower || value >= upper); }
};

/// Which values: all of free_values(), or those of motors and joints only, the bodies' as stated.
enum class Freed { all, drives };

/// The laws whose values are freed, by what they are of: masses, drives, offsets, friction.
struct FreedKind {
  std::string name;
  std::vector<std::string> laws;
  bool has(const std::string& law) const;
};
const std::vector<FreedKind>& freed_kinds();
/// Is the law of one of them?
bool is_freed(const std::string& law);

/// A model with an effect for everything that may move.
struct FreeModel {
  model::Model model;
  std::size_t own = 0;  ///< effects that it had before; the added ones are behind them, at their null values
  std::vector<FreeValue> values;
  Eigen::MatrixXd correlation{};  ///< of the identified values; empty: not known
};

/// Free are, where the model has such an effect its own value, else that of one more at the place:
///   added_mass, com_shift, link_inertia      of each body with a mass: its ten inertial parameters
///   rotor_inertia, torque_bias, torque_constant_error, viscous, coulomb      of each motor in `scales`;
///                                   friction where the model has it already: at the motor or what it drives;
///   viscous, coulomb                of what else is in `scales`: joints without a motor.
/// Spread: what the model states (mass, rotor inertia, torque constant, effects' values); else 10 % of the
/// mass, the largest side of the link's box for its centre of mass, a stretch of 0.2 of its inertia, 20 % of
/// the rotor inertia but a tenth of what the motor feels at least, 10 % of a torque constant, the rms torque
/// for Coulomb friction and bias, and that by the rms velocity for viscous friction. Limits: mass at least a
/// tenth of the stated one, the centre of mass in model::link_box(), a stretch of at most e, rotor inertia
/// not below zero, friction likewise, torque constant at least a tenth.
FreeModel free_values(const model::Model& model, const std::map<std::string, MotorScales>& scales,
                      Freed freed = Freed::all);

/// The values as parameters of a fit to windows, what is known of them weighed against residuals `scale`
/// times as large as the floors.
std::vector<FreeParameter> as_parameters(const FreeModel& free, double scale = 1.0);

/// What is stated of the values: with d = (value - stated) / spread of those that are known, and C how these
/// hang together (Model::correlations), the information C^-1 in the rows and columns of all values, zero for
/// those of which nothing is known.
Eigen::MatrixXd stated_information(const FreeModel& free);
/// d' C^-1 d: how far the values are from what is stated.
double stated_misfit(const FreeModel& free);

/// The model with other values.
model::Model identified(const FreeModel& free);
void set_value(model::Model& model, const model::ParameterId& id, double value);

}  // namespace plumbline::validation
