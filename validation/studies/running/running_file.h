// Files of the design of a running gait: what is wanted, and the controller's file that comes out.
#pragma once

#include <string>

#include "controllers/monopod/parameters.h"
#include "validation/studies/running/design.h"
#include "validation/studies/running/return_map.h"

namespace plumbline::validation {

struct RunningDesignFile {
  std::string file, model_file;
  RunningDesign design;
  OuterLoopWeights weights;
};

/// `plumbline: running_design/1` with the model and the curves that it names. Throws InputError (one line:
/// file, line, key, found, expected).
RunningDesignFile read_running_design(const std::string& path);

/// Writes `path`, a controller's file on `base_file` (which has library, wiring, period and limits), with the
/// robot, the gait and the gains of `done`. Every number says that it is assumed, and where it is from.
void write_running(const std::string& path, const std::string& base_file, const DesignedRunning& done,
                   const RunningDesignFile& file);

/// Robot and gait of a controller's file, as its library has them. Throws InputError where the file is of
/// another controller.
monopod::Parameters read_running(const std::string& controller_file);

}  // namespace plumbline::validation
