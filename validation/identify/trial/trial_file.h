// trial.yaml as it is written: what is named where, before any data are read.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "contact/terrain.h"
#include "simulator/model/model.h"
#include "simulator/model/yaml_node.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// A column that trial.yaml asks for. The place is that of the key, for messages.
struct ColumnUse {
  std::string name;
  std::string unit;           ///< empty: the data file must say it
  std::string expected_unit;  ///< of the sensor or motor it belongs to
  std::string owner;          ///< "sensor q", for messages
  Place_in_file place;
  double scale = 1.0;      ///< of what stands in the column: -1 turns it over, 0.088 makes degrees of counts
  double offset = 0.0;     ///< added behind that, SI
  double turn = 0.0;       ///< the column wraps around after this, SI; 0: it does not
  bool has_topic = false;  ///< it names its own; `name` then begins with it
};

/// A stretch of the recording, s.
struct Section {
  double from = 0.0;
  double to = 0.0;
  Place_in_file place;
};

struct MeasuredUse {
  std::string sensor;
  ColumnUse column;
  std::optional<Section> zero{};       ///< of a force plate: when nothing stood on it
  std::optional<double> above{};       ///< of a contact switch that is read off a force: closed above it, N
  std::optional<double> resolution{};  ///< of this record in place of the model's, SI
  std::optional<double> noise{};
  double offset_uncertainty = 0.0;  ///< SI
  /// Of an orientation, instead of `column`: those of the quaternion, w x y z. `sensor` names all three
  /// components.
  std::vector<ColumnUse> quaternion{};
};
struct CommandUse {
  std::string motor;
  ColumnUse column;
  std::optional<double> before{};
};
struct ControllerUse {
  Controller controller;  ///< without the recorded signals
  ColumnUse reference;
  std::optional<ColumnUse> disturbance{};
  std::optional<ColumnUse> velocity{};            ///< of a pd; without it the measurement is differenced
  std::optional<ColumnUse> reference_velocity{};  ///< of a pd; without it none
  Place_in_file place{};
};

/// How uneven sampling becomes even.
struct LogSampling {
  double period = 0.0;       ///< s; 0: the median step, and even sampling stays as it is
  bool even = false;         ///< the samples were even, only their stamps jitter
  double longest_gap = 0.0;  ///< s; over longer gaps nothing is interpolated; 0: five periods
  Place_in_file place{};
};

struct TrialFile {
  std::string path;    ///< of trial.yaml
  std::string folder;  ///< where it lies
  std::string title;
  std::string model_file;
  Role role = Role::train;
  std::string data;             ///< as written
  std::string data_folder_env;  ///< empty: none
  Place_in_file data_folder_env_place;
  std::vector<std::string> columns;          ///< of a data file without header; empty: it has one
  std::string topic;                         ///< of a bag, for columns that name none; empty: they name it
  std::optional<Place_in_file> topic_place;  ///< of the first `topic`, here or at a column; none: no bag
  ColumnUse time;                            ///< without a name where the rate is given
  double rate = 0.0;                         ///< Hz, the first row is at 0 s; 0: a column holds the time
  LogSampling sampling;
  bool fill_missing = false;        ///< cells without a number are bridged like gaps; else they are refused
  bool leave_out_bad_rows = false;  ///< rows whose time cannot be; else they are refused
  std::vector<Section> sections;    ///< what the trial is made of; empty: the whole recording
  std::vector<Section> left_out;    ///< and what is not used of it
  double clock_shift_uncertainty = 0.0;  ///< s
  std::vector<MeasuredUse> measured;
  std::vector<CommandUse> commands;
  std::vector<ControllerUse> controllers;
  std::vector<Lock> locks;
  contact::Terrain terrain;
  std::vector<model::EffectUse> configuration;
  std::vector<Start> start;
  std::vector<double> events;
};

/// Every column that the file asks for, the time first.
void for_each_column(TrialFile& file, const std::function<void(ColumnUse&)>& visit);

/// train, held-out or test.
Role read_role(const model::YamlNode& node);

/// The trial.yaml that a path to it or to its folder means.
std::string trial_yaml(const std::string& path);

/// The model file named in trial.yaml, resolved.
std::string read_model_path(const model::YamlNode& root);

/// Refuses a name that is neither a coordinate nor a motor; returns its unit, rad or m.
std::string placed_unit(const model::YamlNode& node, const std::string& name, const model::Model& model);

/// The motor of this name; throws InputError with the nearest names.
const model::Motor& known_motor(const model::YamlNode& node, const std::string& name,
                                const model::Model& model);

/// A controller's kind, motor, sensor and constants; its recorded signals are left empty.
Controller read_controller_law(const model::YamlNode& node, const model::Model& model);

TrialFile read_trial_file(const std::string& path, const model::Model& model);

}  // namespace plumbline::validation
