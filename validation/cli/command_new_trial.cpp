#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_new_trial(CLI::App& /*app*/, Outcome& /*outcome*/) {}

}  // namespace plumbline::cli
