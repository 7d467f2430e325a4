// What somebody needs to make the same report again.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "simulator/model/model.h"
#include "validation/identify/trial/trial.h"

namespace plumbline::validation {

struct Repetition {
  std::vector<std::string> command;  ///< words of the command line
  std::vector<std::string> models;   ///< model files, overlays and what they stand on
  std::vector<std::string> others;   ///< further files that were read
  unsigned seed = 0;                 ///< of the resampling
  bool resampled = false;            ///< false: nothing was drawn at random
  double window = 0.0;               ///< s
};

/// {"version", "program", "compiler", "libraries", "command", "window", "seed", "files": [{"file", "kind",
/// "sha256"}]}; `program` is the hash of the running program itself.
nlohmann::json repeat_json(const Repetition& repetition, const model::Model& model,
                           const std::vector<Trial>& trials);

/// One hash for the running program and all files from which the model and the trials were read.
std::string inputs_hash(const model::Model& model, const std::vector<Trial>& trials);

/// Words as a POSIX shell takes them: quoted where they need it.
std::string shell_line(const std::vector<std::string>& words);

}  // namespace plumbline::validation
