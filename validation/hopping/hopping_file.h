// The hopping controller's constants as a file.
#pragma once

#include <string>

#include "controllers/mabel_hopping/hopping_config.h"

namespace plumbline::validation {

/// Reads `plumbline: controller/1` with `controller: hopping`: every number a quantity with unit and source
/// (or assumed). The encoders' resolutions are the robot model's and not in it. Throws InputError (one line:
/// file, line, key, found, expected), also for what the controller itself refuses.
///
/// A file with a `base` states only what it changes of that file.
controllers::HoppingConfig read_hopping(const std::string& path);

/// Writes what a search changes (gains, K_T, lengths of the rate filters) as a file `path` on `base_file`,
/// with `note` on the search. Throws InputError when the two are one file, std::runtime_error when it cannot
/// be written.
void write_gains(const std::string& path, const std::string& base_file,
                 const controllers::HoppingConfig& config, const std::string& note);

}  // namespace plumbline::validation
