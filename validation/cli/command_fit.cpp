#include "validation/cli/commands.h"

namespace plumbline::cli {

void add_fit(CLI::App& /*app*/, Outcome& /*outcome*/) {}

}  // namespace plumbline::cli
