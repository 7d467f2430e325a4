// The texts that `plumbline new-model` writes.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "simulator/model/stated_drives.h"
#include "validation/api/new_model_columns.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::api {

/// A torque constant, and where it comes from.
struct Gain {
  double value = 1.0;  ///< N m/A or N/A
  double share = 1.0;  ///< standard deviation, of the value
  std::string why;     ///< what stands under `assumed`
};

/// A moving joint of the skeleton, and how the model calls what belongs to it.
struct PlannedJoint {
  const model::Joint* joint = nullptr;
  JointColumns columns;
  std::string coordinate, motor;
  bool has_drive = false;  ///< by the file: an actuator (MJCF) or a transmission (URDF)
  const model::MjcfActuator* actuator = nullptr;  ///< of an MJCF file, on this joint
  double noise = 0.0;                             ///< of its position, as an MJCF file states it; rad or m
  double small_inertia = 0.0;                     ///< of a rotor where the file states none, kg m^2 or kg
  Gain gain;
};

struct Plan {
  const model::Skeleton* skeleton = nullptr;
  std::string skeleton_path;                  ///< relative to the model
  std::string command_unit;                   ///< "A" or "N m"
  const validation::LogLook* look = nullptr;  ///< nullptr: no log
  std::vector<PlannedJoint> joints;
  bool floating_base = false;  ///< by the wish, not by the skeleton

  /// The file or a command in the log says that a joint is driven. Where neither says it of this joint, it is
  /// driven only if they say it of none: then nothing is known. A joint that the log does not show is no
  /// sign.
  bool is_driven(const PlannedJoint& one) const;
  /// Has the log nothing of this joint, and something of others? Then the trials hold it still.
  bool is_held(const PlannedJoint& one) const;
};

/// Names for coordinates and motors that a model may give and no other has; inertias to begin with.
std::vector<PlannedJoint> plan_joints(const model::Skeleton& skeleton);

/// What the file says of the joints' drives and sensors; `drives` must live as long as `joints`.
void add_drives(const model::MjcfDrives& drives, std::vector<PlannedJoint>& joints);
void add_transmissions(const std::set<std::string>& driven, std::vector<PlannedJoint>& joints);

/// Does the new model have what the skeleton's sentence says is left out of it: actuators, as motors?
bool is_taken_by_new_model(const std::string& left_out);

/// The text of model.yaml. Every value has its source or the reason of an assumption.
std::string model_text(const Plan& plan);

/// The text of a trial.yaml: `from` and `to` in s of the log's time; paths as they are to stand there.
std::string trial_text(const Plan& plan, validation::Role role, double from, double to,
                       const std::string& data, const std::string& model_file);

}  // namespace plumbline::api
