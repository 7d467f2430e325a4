// The hopping controller's constants as a file.
#pragma once

#include <string>

#include "controllers/hopping_config.h"

namespace plumbline::validation {

/// Reads `plumbline: controller/1` with `controller: hopping`: every number a quantity with unit and source
/// (or assumed). The encoders' resolutions are the robot model's and not in it. Throws InputError (one line:
/// file, line, key, found, expected), also for what the controller itself refuses.
controllers::HoppingConfig read_hopping(const std::string& path);

}  // namespace plumbline::validation
