#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_add(CLI::App& /*app*/, Outcome& /*outcome*/) {}

}  // namespace plumbline::cli
