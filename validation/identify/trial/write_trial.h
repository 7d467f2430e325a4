// Trials as files: what twin experiments leave behind, and what new-trial gives to begin with.
#pragma once

#include <string>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

/// Writes a folder with trial.yaml and data.csv, from which read_trial(folder, model) gives the same trial
/// (numbers to 15 digits). Measured and commanded columns keep their names and units; empty ones become
/// q_SENSOR and u_MOTOR in SI. The model's path becomes relative to the folder. The folder appears whole or
/// not at all; throws InputError when it exists and is not empty, or cannot be written.
void write_trial(const Trial& trial, const model::Model& model, const std::string& folder);

/// Writes a template folder: trial.yaml with every key explained, data.csv with a few rows, README.md. Same
/// errors as write_trial.
void new_trial_template(const std::string& folder);

}  // namespace plumbline::validation
