// The force that a measured motion needs under a model, held against the force that was commanded.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// Frequencies above half the sample rate are brought down to 0.4 times the sample rate.
struct InverseModelOptions {
  double motion_cutoff = 100.0;  ///< Hz: low-pass of the measured positions before they are differentiated
  double force_cutoff = 40.0;    ///< Hz: low-pass of both forces before they are compared
};

/// One motor. The vectors leave out two periods of the force cutoff at both ends, where filters and
/// differences know too little.
struct NeededForce {
  std::string motor;
  std::string unit;                                  ///< N m or N
  Eigen::VectorXd recorded;                          ///< torque gain times recorded command, low-passed
  Eigen::VectorXd needed;                            ///< what the motion needs, low-passed
  Eigen::VectorXd position, velocity, acceleration;  ///< of the motor, SI

  /// 100 |recorded - needed| / |recorded|, Euclidean norms over all samples.
  double error_percent() const;
};

struct InverseModel {
  std::string not_available;  ///< the reason; empty: the results hold
  std::vector<NeededForce> motors;
  double cutoff = 0.0;  ///< Hz: below which both forces were compared
};

/// Needed commands are those that give the measured acceleration a at the measured position and velocity:
///   u_needed = u + (da/du)^-1 (a - a(u)), with the recorded command u,
/// exact where the acceleration is affine in the command, as with all laws but load-dependent friction; there
/// it is one step of Newton's method from the recorded command.
/// Motion: the measured positions, low-passed without phase, then central differences
///   v = (q_(k+1) - q_(k-1)) / (2 T),  a = (q_(k+1) - 2 q_k + q_(k-1)) / T^2.
/// Both forces then pass the same low-pass, so that only frequencies that the position shows are compared.
/// The recorded command counts at the sample at which it was given; that it is held until the next one makes
/// it half a sample late on average, which sharp pulses feel. A command beyond a motor's torque limit counts
/// as the limit; what is needed may be more. Source: A. Janot, M. Gautier, M. Brunot, Data set and reference
/// models of EMPS, 2019, who use these cutoffs, and decimate by ten where we only filter.
///
/// Not available when the model has hidden states, when the sensors do not show every position, and unless
/// the motors that can move are as many as the independent positions.
InverseModel inverse_model(const model::Model& model, const Trial& trial, const InverseModelOptions& options);

/// What the sensors alone make of the needed force, one root mean square for each motor of `inverse`, N m or
/// N: the difference that the floors of the position sensors, as white noise on top of what was measured,
/// make after the same filters and differences. Differencing twice raises a coarse encoder's counts by (2 pi
/// f)^2, so that a force error of this size says nothing of the model.
std::vector<double> force_floors(const model::Model& model, const Trial& trial, const InverseModel& inverse,
                                 const InverseModelOptions& options);

/// How the needed force follows the commanded one: needed = gain * commanded, by least squares about the
/// means. Nothing missing: gain 1. `core` is the same after everything was projected out that friction,
/// springs and offsets missing from the model could explain (1, q, v, sign v): what is left is inertia.
struct CommandGain {
  std::string motor;
  double gain = 0.0, correlation = 0.0;
  double core_gain = 0.0, core_correlation = 0.0;
  bool rotor_is_open = false;  ///< the model states an uncertainty of the rotor's inertia
  /// Friction and a multiple of the acceleration leave less of the commanded force than friction and a
  /// factor.
  bool a_rotor_says_more = false;

  /// The better correlated of the two gains: nearest to the factor between two units.
  double factor() const { return core_correlation > correlation ? core_gain : gain; }
  /// The core follows the commanded force by a factor of 1/4 to 4: the unit of this command is right.
  bool follows() const;
  /// True when no missing effect explains the gain: needed and commanded force follow each other
  /// (correlation above 0.7) by a factor outside 1/4 to 4. Where the motion needs less than commanded,
  /// friction or a spring that the model lacks could be the reason, so there the core must say the same; and
  /// a rotor behind a gear may be many times what was guessed, so that an open one must not say more.
  bool implausible() const;
};

/// One for each motor that can move; empty when the inverse model is not available.
std::vector<CommandGain> command_gains(const model::Model& model, const Trial& trial);

/// Throws InputError that names trial, command column, unit and factor when a command's gain is implausible:
/// a unit was declared wrongly, in the trial or in the model. One command that follows speaks for all columns
/// in its unit: a joint that carries only a light wrist needs a fraction of its torque when a load hangs
/// there that the model does not know.
void check_command_units(const model::Model& model, const Trial& trial);

}  // namespace plumbline::validation
