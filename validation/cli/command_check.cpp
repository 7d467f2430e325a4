#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_check(CLI::App& /*app*/, Outcome& /*outcome*/) {}

}  // namespace plumbline::cli
