// The controllers that a trial.yaml says were at work.
#pragma once

#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial_file.h"

namespace plumbline::validation {

/// At most one for each motor.
std::vector<ControllerUse> read_controllers(const model::YamlNode& node, const model::Model& model);

/// Refuses a pd whose sensor is not measured, or whose motor's command was recorded, too.
void check_controllers(const TrialFile& file);

}  // namespace plumbline::validation
