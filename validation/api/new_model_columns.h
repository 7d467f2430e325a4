// Which column of a log belongs to which joint.
#pragma once

#include <string>
#include <vector>

#include "validation/identify/trial/log_look.h"

namespace plumbline::api {

/// What a joint may have in a log.
struct JointColumns {
  std::string joint;  ///< name in the skeleton
  bool angular = true;
  int position = -1;  ///< index in LogLook::columns; -1: none
  int command = -1;
  bool position_by_number = false;  ///< q1, q2, ...: the joints in the skeleton's order
  bool command_by_number = false;
};

/// Fills in the columns. By name first: the column is called as the joint, or holds its name (without a word
/// `joint`, in any case); of several joints the one with the longest name has it, of several columns the one
/// with the shortest name is taken. Then, for positions and commands each and only where no name matched, by
/// number: columns PREFIX1 ... PREFIXn, as many as there are joints. What a column is follows from its unit
/// and the other words of its name (log_look.h); rates, references and units of another dimension than
/// `command_unit` or the joint's are left alone.
void match_columns(const validation::LogLook& look, const std::string& command_unit,
                   std::vector<JointColumns>& joints);

/// The unit of the motor of a joint: `N m` becomes `N` where the joint slides.
std::string command_unit_at(const std::string& command_unit, bool angular);

}  // namespace plumbline::api
