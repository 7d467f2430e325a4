// A trial.yaml that a person only corrects, from what a log looks like.
#pragma once

#include <string>

#include "simulator/model/model.h"
#include "validation/identify/trial/log_look.h"

namespace plumbline::validation {

/// The text of a trial.yaml for a log. With a model its sensors, switches and motors get the columns whose
/// names and units are nearest; without one (nullptr) they are called after the columns. `data` and
/// `model_file` are written as given. What is a guess says so behind it.
std::string trial_text(const LogLook& look, const model::Model* model, const std::string& data,
                       const std::string& model_file);

/// Reads a log and looks at it; `topics` of a bag: see LogQuestion. Throws InputError when it cannot be read.
LogLook look_at_log(const std::string& log, const std::vector<std::string>& topics);

/// Writes a folder with such a trial.yaml, whose data stay where the log is. The folder appears whole or not
/// at all; throws InputError when it exists and is not empty, or the log cannot be read. `topics` of a bag:
/// see LogQuestion.
LogLook new_trial_from_log(const std::string& folder, const std::string& log, const model::Model* model,
                           const std::vector<std::string>& topics = {});

}  // namespace plumbline::validation
