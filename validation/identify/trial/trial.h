// One recorded experiment, read from a folder with trial.yaml and its data, checked and in SI.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/model.h"

namespace plumbline::validation {

/// train: may be fitted. held_out: is predicted, and decides between models. test: is neither fitted nor used
/// to choose; the error of what was chosen is reported on it.
enum class Role { train, held_out, test };
/// "train", "held-out", "test"
std::string to_string(Role role);

/// A channel measured by one of the model's sensors.
struct Measured {
  std::string sensor;                  ///< name of a sensor of the model
  std::string column;                  ///< column in the data file
  std::string unit;                    ///< as declared
  Eigen::VectorXd values;              ///< SI
  std::optional<double> resolution{};  ///< of this record in place of the model's sensor's, SI
  std::optional<double> noise{};       ///< standard deviation, likewise
  /// One standard deviation of a constant zero error of this record, SI; 0: none. A nuisance: an estimate may
  /// move the channel by one constant in the whole trial, at this cost.
  double offset_uncertainty = 0.0;
};

/// A contact switch's record: 1 closed, 0 open.
struct SwitchRecord {
  std::string name;  ///< of a contact switch of the model
  std::string column;
  Eigen::VectorXd values;
  double closes_late = 0.0, opens_late = 0.0;  ///< s, as the model's switch says
  double lateness_uncertainty = 0.0;           ///< s
  double bounce = 0.02;                        ///< s
};

/// The record of a switch of the model, with its lateness and bounce; `closed` as it was read, 1 or 0.
SwitchRecord record_of(const model::ContactSwitch& contact, const std::string& column,
                       Eigen::VectorXd closed);

/// What the switch reads where its contact is truly closed (1) or open (0): later by a whole number of
/// samples.
Eigen::VectorXd read_late(const model::ContactSwitch& contact, const Eigen::VectorXd& closed, double period);

/// A recorded command of one motor, held over each sample.
struct Command {
  std::string motor;
  std::string column;
  std::string unit;
  Eigen::VectorXd values;  ///< in the motor's command unit (SI of it)
  std::string law{};       ///< where it was computed: by which law from what; empty: recorded
  /// What held before the recording's first row; none: its first value.
  std::optional<double> before{};
};

using model::Lock;

/// A controller that ran on the robot and is known: u = velocity_gain (position_gain (r - y) - dy/dt) +
/// disturbance of a cascade_pd; u = position_gain (r - y) + velocity_gain (dr/dt - dy/dt) + disturbance of a
/// pd, whose position_gain is in command units per position unit.
struct Controller {
  std::string kind;  ///< "cascade_pd" or "pd"
  std::string motor;
  std::string sensor;
  double position_gain = 0.0;   ///< 1/s
  double velocity_gain = 0.0;   ///< command unit s per position unit
  double command_limit = 0.0;   ///< 0: none
  int velocity_over = 1;        ///< samples n of its difference dy/dt = (y_k - y_(k-n)) / (n T): 1 or 2
  Eigen::VectorXd reference;    ///< SI
  Eigen::VectorXd disturbance;  ///< added to the command, empty: none
};

/// An instant at which a contact switch closed (touchdown) or opened (lift-off): half a sample before the
/// first sample that shows it, uncertain by half a sample either way.
struct ContactEvent {
  double time = 0.0;  ///< s, of the contact itself: how late the switch is, is taken off
  Eigen::Index sample = 0;
  int record = 0;  ///< index in Trial::switches
  bool touchdown = true;
};

/// A coordinate's position at a start, rad or m.
struct Start {
  std::string coordinate;
  double position = 0.0;
  double deviation = 0.0;  ///< how well that is known, one standard deviation
};

/// Samples `first` to before `end` that hang together.
struct Stretch {
  Eigen::Index first = 0, end = 0;
};

struct Trial {
  std::string file;  ///< trial.yaml
  std::string name;  ///< folder name
  std::string title;
  std::string model_file;  ///< as named in trial.yaml, resolved
  std::string data_file;
  Role role = Role::train;
  Eigen::Index first_row = 0;  ///< of the data file that is the first sample
  Eigen::VectorXd time;        ///< s, strictly increasing, uniform within 1 %
  /// What may be used, in the order of time; empty: all. Between stretches the recording has a gap, or
  /// trial.yaml leaves something out: there commands are held and channels interpolated, only so that time
  /// goes on evenly, and no window reaches in.
  std::vector<Stretch> stretches{};
  /// One standard deviation, s, of one constant by which all measured channels may be late or early against
  /// the commands (two clocks); 0: none. A nuisance, like Measured::offset_uncertainty.
  double clock_shift_uncertainty = 0.0;
  /// How the robot differed from the model in this trial, known beforehand (a payload): effects without
  /// states of their own, added behind all those of whatever model is tried (as_recorded).
  std::vector<model::EffectUse> configuration{};
  std::vector<std::string> remarks{};  ///< what was done to the recording, a sentence each
  double period = 1e-3;                ///< s
  std::vector<Measured> measured;
  std::vector<Command> commands;
  std::vector<Lock> locks;
  contact::Terrain terrain;  ///< that it ran on; level ground at 0 m unless stated
  std::vector<Controller> controllers;
  std::vector<Start> start;    ///< where windows begin with what no sensor shows
  std::vector<double> events;  ///< times at which windows are cut
  std::vector<SwitchRecord> switches;
  std::vector<ContactEvent> contact_events;  ///< of `switches`, in the order of time

  Eigen::Index samples() const { return time.size(); }
};

/// The trial's stretches; the whole trial where it states none.
std::vector<Stretch> stretches_of(const Trial& trial);

/// The model's sensor with the resolution and noise that the record states instead.
model::Sensor sensor_of(const model::Model& model, const Measured& measured);

/// The model with the sensors as this trial's records state them, and with the trial's configuration behind
/// its effects: their indices stay what they are.
model::Model as_recorded(const model::Model& model, const Trial& trial);

/// Standard deviation of a contact event's time when it may lie anywhere in a sample period: T/sqrt(12).
double timing_floor(const Trial& trial);
/// The same of a switch that is late by a time that is not well known: sqrt(T^2/12 + lateness_uncertainty^2).
double timing_floor(const Trial& trial, int record);

/// Where the trial's switches change. A change back within SwitchRecord::bounce is bouncing of the switch or
/// of the foot, which a small error of the model may miss, and no event: both changes are left out.
std::vector<ContactEvent> contact_events(const Trial& trial);

/// A time in which no contact switch is closed.
struct Flight {
  double lift_off = 0.0, touchdown = 0.0;  ///< s; where the recording does not show one, its own end
  Eigen::Index first = 0, end = 0;         ///< first sample, and the first one behind it
  int record = -1;                         ///< index in Trial::switches of the one that closes; -1: none
  bool begins = false, ends = false;       ///< within the recording
};

/// A time on the ground from one flight to the next: first sample, and the first one behind it.
struct Stance {
  Eigen::Index first = 0, end = 0;
};

/// In the order of time, from contact_events: two feet that come down one after the other end one flight.
std::vector<Flight> flights_of(const Trial& trial);
std::vector<Stance> stances_of(const Trial& trial);

/// The flight in which a sample lies; empty where a switch is closed, and where the recording does not show
/// both ends of the flight.
std::optional<Flight> flight_at(const Trial& trial, Eigen::Index sample);

struct TrialOptions {
  std::string data_folder;  ///< replaces the trial's data folder; empty: as the trial says
};

/// `path` is a folder or a trial.yaml. The model gives the sensors' and motors' names and units.
Trial read_trial(const std::string& path, const model::Model& model, const TrialOptions& options = {});

/// Commands sample by sample, motors of the model x samples; zero for a motor without a command.
Eigen::MatrixXd command_samples(const model::Model& model, const std::vector<Command>& commands,
                                Eigen::Index samples);

/// What each motor of the model was commanded before the first sample.
Eigen::VectorXd commands_before(const model::Model& model, const std::vector<Command>& commands);

/// Only the model file that a trial names (resolved relative to the trial), to read the model first.
std::string model_of_trial(const std::string& path);

/// Throws InputError when two trials with different roles have data in common (rows of one file, or the same
/// numbers).
void check_roles(const std::vector<Trial>& trials);

}  // namespace plumbline::validation
