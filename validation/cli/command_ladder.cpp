#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_ladder(CLI::App& /*app*/, Outcome& /*outcome*/) {}

}  // namespace plumbline::cli
