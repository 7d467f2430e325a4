// A model.yaml to correct, from a skeleton and perhaps a log.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace plumbline::api {

struct NewModelWish {
  std::string skeleton;             ///< .urdf, .sdf or .xml (MJCF)
  std::string log;                  ///< empty: none
  std::vector<std::string> topics;  ///< of a bag: see LogQuestion
  std::string file;                 ///< model.yaml; must not exist
  std::string command_unit;         ///< "A" or "N m"; empty: that of the log's commands, else N m
  bool floating_base = false;       ///< the root link, to which no joint leads, floats
};

/// One joint of the new model, and its columns in the log (empty: none matched).
struct NewJoint {
  std::string joint, motor, position, command;
  bool position_by_number = false, command_by_number = false;
  double torque_constant = 0.0;  ///< 0: the command is a torque or force
  std::string torque_constant_from;
};

struct NewModel {
  std::string file, command_unit;
  std::vector<NewJoint> joints;
  std::vector<std::string> trials;   ///< folders: train, then held-out; empty: no log
  std::vector<std::string> unused;   ///< columns that belong to no joint
  std::vector<std::string> remarks;  ///< a sentence each
};

/// Writes a model file in which every moving joint has a motor, a ratio of 1 and a sensor; and, with a log
/// that has columns of the joints, two trial folders beside it: LOG_train (the first 60 % of its time) and
/// LOG_held_out (the rest). The model is read back before it gets its name. For motors commanded by a current
/// the torque constant is assumed to be 1 N m/A; where the train trial shows by what factor the needed force
/// follows the current (command_gains), that factor is assumed. Throws InputError, and leaves nothing behind,
/// when the skeleton cannot be read, has no moving joint, or no root that could float as asked, a file of
/// that name exists, or the log has no time or no column of any joint.
NewModel new_model(const NewModelWish& wish);

/// docs/formats/json.md, `new-model`.
nlohmann::json to_json(const NewModel& made);

}  // namespace plumbline::api
